#ifndef mesoslip_material_bounds_h
#define mesoslip_material_bounds_h

#include "material/voigt.h"

#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * Voigt's bound, the mean of C (Pa), uniform strain: no composite is stiffer.
 * All functions here throw std::invalid_argument unless there is one fraction in [0, 1]
 * a phase and the fractions sum to one (1e-9).
 */
template <int dim>
VoigtMatrix<dim> voigt_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions);

/** Reuss' bound, the inverse of the mean of C^-1 (Pa), uniform stress: no composite is
 * softer. */
template <int dim>
VoigtMatrix<dim> reuss_bound(const std::vector<Phase<dim>> &phases,
                             const std::vector<double> &fractions);

/** Plane bulk modulus k = lambda + mu and shear modulus mu, Pa. */
struct PlaneModuli
{
  double bulk;  ///< k = lambda + mu
  double shear; ///< mu
};

/** Isotropic plane-strain stiffness (Pa) of given plane moduli. */
VoigtMatrix<2> plane_isotropic_stiffness(const PlaneModuli &moduli);

/** Lower and upper bound of the moduli of an isotropic composite. */
struct HashinShtrikmanBounds
{
  PlaneModuli lower; ///< Pa
  PlaneModuli upper; ///< Pa
};

/**
 * Hashin-Shtrikman(-Walpole) bounds in plane strain for any number of isotropic phases:
 *   k(G)  = 1 / sum f_i / (k_i + G)  - G,   G = min, max mu_i
 *   mu(H) = 1 / sum f_i / (mu_i + H) - H,   H = k mu / (k + 2 mu) of min, max moduli.
 * They hold for morphologies that are isotropic in the plane; aligned fibres need not
 * lie between them. Empty when a phase is not isotropic.
 */
std::optional<HashinShtrikmanBounds>
hashin_shtrikman_bounds(const std::vector<Phase<2>> &phases,
                        const std::vector<double> &fractions);
} // namespace mesoslip

#endif
