#ifndef mesoslip_material_bounds_h
#define mesoslip_material_bounds_h

#include "material/voigt.h"

#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * Voigt's bound, the mean of C (Pa), uniform strain: no composite is stiffer. All
 * functions here throw std::invalid_argument unless there is one fraction in [0, 1] per
 * phase and the fractions sum to one (1e-9).
 */
template <int dim>
VoigtMatrix<dim> voigt_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions);

/** Reuss' bound, the inverse of the mean of C^-1 (Pa), uniform stress: no composite is
 * softer. */
template <int dim>
VoigtMatrix<dim> reuss_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions);

/** Bulk and shear modulus, Pa. */
struct IsotropicModuli
{
  double bulk;  ///< k = lambda + 2 mu / dim; in 2D plane strain, lambda + mu
  double shear; ///< mu
};

/** Isotropic stiffness (Pa) of given moduli; in 2D of plane strain. */
template <int dim>
VoigtMatrix<dim> isotropic_stiffness(const IsotropicModuli &moduli);

/** Lower and upper bound of the moduli of an isotropic composite. */
struct HashinShtrikmanBounds
{
  IsotropicModuli lower; ///< Pa
  IsotropicModuli upper; ///< Pa
};

/**
 * Hashin-Shtrikman(-Walpole) bounds for any number of isotropic phases:
 *   k(G)  = 1 / sum f_i / (k_i + G)  - G,
 *   mu(H) = 1 / sum f_i / (mu_i + H) - H
 * with the smallest and the largest moduli k and mu of all phases in
 *   G = mu,       H = k mu / (k + 2 mu)                        (2D, plane strain)
 *   G = 4 mu / 3, H = mu (9 k + 8 mu) / (6 (k + 2 mu))         (3D).
 * They hold for morphologies that are isotropic (2D: in the plane); aligned fibres need
 * not lie between them. Empty when a phase is not isotropic.
 */
template <int dim>
std::optional<HashinShtrikmanBounds>
hashin_shtrikman_bounds(const std::vector<Phase<dim>> &phases,
                        const std::vector<double> &fractions);
} // namespace mesoslip

#endif
