#ifndef mesoslip_elasticity_brick_coefficients_h
#define mesoslip_elasticity_brick_coefficients_h

/**
 * Numbers that describe the stiffness of a brick to the kernels. Where one is apart, some phase has
 * another stiffness about the mean strain of a cell than that against the mean
 * (ElasticPhase::stiffness_about_mean).
 */
namespace mesoslip
{
constexpr unsigned int n_isotropic = 2; ///< Lame's two
/** Lame's two and the first one about the mean. */
constexpr unsigned int n_isotropic_apart = 3;
/** Of isotropic cubes, apart or not: lambda, mu, and with lambda about the mean lambda / 3 and
 * (lambda + 4 mu) / 9. */
constexpr unsigned int n_cubes = 4;
/** Of phases whose axes are those of the body: D11, D12, D13, D22, D23, D33, D44, D55, D66. */
constexpr unsigned int n_orthotropic = 9;

constexpr unsigned int n_plane = 6; ///< in the plane: the upper triangle of xx, zz, xz
constexpr unsigned int n_plane_apart = 12; ///< the same for the mean, then about it

constexpr unsigned int n_general       = 21; ///< the upper triangle of the Voigt matrix
constexpr unsigned int n_general_apart = 42; ///< the same for the mean, then about it

/** Numbers of a material in tables of many: of n_general or n_general_apart, one more, and room up
 * to whole cache lines. */
constexpr unsigned int n_of_material(const unsigned int n_coefficients)
{
  return (n_coefficients + 8) / 8 * 8;
}
} // namespace mesoslip

#endif
