#ifndef mesoslip_contact_pair_mortar_weights_h
#define mesoslip_contact_pair_mortar_weights_h

#include "contact/pair/moving_weights.h"

#include <array>
#include <vector>

namespace mesoslip
{
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
class MortarWeights : public MovingWeights
{
public:
  /** Of the @p upper surface over the @p lower one, which repeats itself after a @p period along x and y (m; 0: not). */
  MortarWeights(const ContactFacets &upper,
                const ContactFacets &lower,
                const std::array<double, 2> &period);

  SurfaceWeights at(const std::array<double, 2> &way) const override;

  /** The rows of these weights alone. */
  SparseRows rows_at(const std::array<double, 2> &way) const;

private:
  /** A facet of the upper surface with its dual functions psi = dual phi. */
  struct Upper
  {
    SurfaceFacet facet;
    std::array<std::array<double, 4>, 4> dual;
    double size; ///< m^2, in 2D m
  };

  /** Integral of psi_i phi_j. */
  struct Product
  {
    unsigned int node; ///< i
    SparseRows::Entry entry;
  };
  struct Work;

  void add_facet(const Upper &upper, const std::array<double, 2> &way, Work &work) const;
  void add_overlaps(const Upper &upper, const SurfaceFacet &facet, Work &work) const;
  SparseRows rows_of(const std::vector<Product> &products) const;

  const unsigned int n_above, n_below;
  std::vector<Upper> above;
  std::vector<SurfaceFacet> below;    ///< in the order of their lowest x
  std::vector<double> first;          ///< lowest x of these (m)
  const std::array<double, 2> period; ///< m
  double longest             = 0.;    ///< of the facets below along x (m)
  SurfaceFacet::Place lowest = {};    ///< of the surface below (m)
};
} // namespace mesoslip

#endif
