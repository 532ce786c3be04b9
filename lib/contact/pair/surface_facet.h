#ifndef mesoslip_contact_pair_surface_facet_h
#define mesoslip_contact_pair_surface_facet_h

#include "base/serialize_members.h"

#include <array>
#include <vector>

namespace mesoslip
{
/**
 * A facet of a contact projected along the normal: an edge, a triangle or a
 * quadrilateral.
 */
struct SurfaceFacet
{
  using Place = std::array<double, 2>; ///< x and, in 3D, y (m)

  unsigned int n                   = 0;  ///< number of corners
  std::array<unsigned int, 4> node = {}; ///< contact nodes in the order around the facet
  std::array<Place, 4> place       = {}; ///< positions of the corners

  /**
   * Values of the shape functions at a position: linear, or bilinear on a quadrilateral.
   */
  std::array<double, 4> shapes(const Place &at) const;

  /** Lower and upper bound along an axis (m). */
  std::array<double, 2> range(const unsigned int axis) const;

  /** Length (m) or area (m^2). */
  double size() const;

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** A quadrature point with its weight, an area (m^2) or length (m). */
struct WeightedPlace
{
  SurfaceFacet::Place place = {}; ///< position of the point (m)
  double weight             = 0.; ///< m^2, of an edge m
};

/**
 * Quadrature points on the overlap of two facets; exact for the product of their shape
 * functions if the facets are edges, triangles or parallelograms.
 */
void quadrature_of_overlap(const SurfaceFacet &one,
                           const SurfaceFacet &other,
                           std::vector<WeightedPlace> &points);
} // namespace mesoslip

#endif
