#ifndef mesoslip_elasticity_brick_coefficients_h
#define mesoslip_elasticity_brick_coefficients_h

/**
 * Numbers of coefficients of the stiffness of a brick. "Apart" means that some phase has
 * one stiffness for the mean strain of a cell and another one for the deviation from it
 * (ElasticPhase::stiffness_about_mean).
 */
namespace mesoslip
{
constexpr unsigned int n_isotropic = 2; ///< Lame's lambda and mu
/** Lame's lambda and mu, and lambda about the mean. */
constexpr unsigned int n_isotropic_apart = 3;
/**
 * Isotropic cubes, apart or not: lambda, mu, and with lambda about the mean lambda / 3
 * and (lambda + 4 mu) / 9.
 */
constexpr unsigned int n_cubes = 4;
/**
 * Phases with material axes along the axes of the body: D11, D12, D13, D22, D23, D33,
 * D44, D55, D66.
 */
constexpr unsigned int n_orthotropic = 9;

constexpr unsigned int n_plane       = 6; ///< plane problem: upper triangle of xx, zz, xz
constexpr unsigned int n_plane_apart = 12; ///< for the mean strain, then about it

constexpr unsigned int n_general       = 21; ///< upper triangle of the Voigt matrix
constexpr unsigned int n_general_apart = 42; ///< for the mean strain, then about it

/**
 * Numbers per material in a table of materials: n_general or n_general_apart, plus one,
 * rounded up to whole cache lines.
 */
constexpr unsigned int n_of_material(const unsigned int n_coefficients)
{
  return (n_coefficients + 8) / 8 * 8;
}
} // namespace mesoslip

#endif
