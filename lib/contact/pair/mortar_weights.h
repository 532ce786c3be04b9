#ifndef mesoslip_contact_pair_mortar_weights_h
#define mesoslip_contact_pair_mortar_weights_h

#include "contact/pair/moving_weights.h"

#include <array>
#include <vector>

namespace mesoslip
{
/**
 * Coupling weights of two surfaces with non-matching nodes, by a mortar method with dual
 * multipliers (Wohlmuth 2000). The pressure on a facet of the upper surface is a
 * combination of linear or bilinear functions psi_i. The integral of psi_i phi_k is zero
 * for other nodes k of the facet, and the integral of phi_i for k = i, so that
 *
 *     W_ij = (integral of psi_i phi_j) / (integral of phi_i)
 *
 * with phi_j of the surface below. A constant pressure is the same on both sides, and a
 * uniform motion of the surface below is reproduced. While the surfaces slide, the
 * integrals are continuously differentiable: forces do not jump when a node passes
 * another one.
 */
class MortarWeights : public MovingWeights
{
public:
  /**
   * Weights of the @p upper surface over the @p lower one, which has a @p period along x
   * and y (m; 0: not periodic).
   */
  MortarWeights(const ContactFacets &upper,
                const ContactFacets &lower,
                const std::array<double, 2> &period);

  SurfaceWeights at(const std::array<double, 2> &way) const override;

  /** Matrix of the weights, by rows. */
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
  std::vector<SurfaceFacet> below;    ///< sorted by their lowest x
  std::vector<double> first;          ///< lowest x of each facet of below (m)
  const std::array<double, 2> period; ///< m
  double longest             = 0.;    ///< longest facet of below along x (m)
  SurfaceFacet::Place lowest = {};    ///< lower corner of the surface below (m)
};
} // namespace mesoslip

#endif
