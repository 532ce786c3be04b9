#ifndef mesoslip_contact_pair_mortar_weights_h
#define mesoslip_contact_pair_mortar_weights_h

#include "contact/pair/surface_facet.h"
#include "contact/pair/surface_weights.h"

#include <array>
#include <vector>

namespace mesoslip
{
/** A contact as its nodes and facets. */
struct ContactFacets
{
  unsigned int n_nodes = 0;         ///< of the whole contact
  std::vector<SurfaceFacet> facets; ///< between them
};

/**
 * The weights of two surfaces whose nodes do not match, by a mortar method with dual multipliers (Wohlmuth 2000): the pressure on a
 * facet of the upper one is a combination of functions psi_i, linear or bilinear, with the integrals of psi_i phi_k none for other
 * nodes k of the facet and that of phi_i for its own, so that
 *
 *     W_ij = (integral of psi_i phi_j) / (integral of phi_i)
 *
 * with phi_j of the surface below. A constant pressure is one on both sides, and what is uniform below is met everywhere. While the
 * surfaces slide the integrals change once continuously differentiable, so that no force jumps where a node passes another one.
 */
class MortarWeights
{
public:
  /** Of the surface @p below, which repeats itself after a @p period along x and y (m; 0: not). */
  MortarWeights(const ContactFacets &above,
                const ContactFacets &below,
                const std::array<double, 2> &period);

  /** With the surface below moved by @p way (m) along x and y. @throws NumericalFailure where it ends below the upper one */
  SurfaceWeights at(const std::array<double, 2> &way) const;

private:
  struct Entry
  {
    unsigned int node;
    double weight;
  };
  struct Scratch;

  void add_facet(const SurfaceFacet &facet,
                 const std::array<double, 2> &way,
                 Scratch &scratch) const;
  void add_overlaps(const SurfaceFacet &moved,
                    const double from,
                    const double to,
                    Scratch &scratch) const;

  const ContactFacets above;
  std::vector<SurfaceFacet> below; ///< in the order of their lowest x
  std::vector<double> first;       ///< lowest x of these (m)
  const std::array<double, 2> period;
  double longest                            = 0.; ///< of the facets below along x (m)
  std::array<SurfaceFacet::Place, 2> extent = {}; ///< of the surface below (m)
};
} // namespace mesoslip

#endif
