#ifndef mesoslip_contact_pair_surface_facet_h
#define mesoslip_contact_pair_surface_facet_h

#include "base/serialize_members.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** A facet of a contact seen along the normal: an edge, a triangle or a quadrilateral. */
struct SurfaceFacet
{
  using Place = std::array<double, 2>; ///< x and, in 3D, y (m)

  unsigned int n = 0; ///< number of corners
  std::array<unsigned int, 4> node =
    {}; ///< of the contact, one after the other around the facet
  std::array<Place, 4> place = {}; ///< of the corners

  /** Values of the shape functions at a @p place: linear, or bilinear on a quadrilateral. */
  std::array<double, 4> shapes(const Place &at) const;

  /** From where to where it goes along an axis (m). */
  std::array<double, 2> range(const unsigned int axis) const;

  /** Length (m) or area (m^2). */
  double size() const;

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<3>(archive, *this);
  }
};

/** A place with its share of an area (m^2) or length (m). */
struct WeightedPlace
{
  SurfaceFacet::Place place = {}; ///< where it is (m)
  double weight             = 0.; ///< m^2, of an edge m
};

/** Points of a quadrature over what two facets have in common, exact for the product of their shape functions where facets are edges,
 * triangles or parallelograms. */
void quadrature_of_overlap(const SurfaceFacet &one,
                           const SurfaceFacet &other,
                           std::vector<WeightedPlace> &points);
} // namespace mesoslip

#endif
