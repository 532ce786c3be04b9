#ifndef mesoslip_elasticity_brick_coefficients_h
#define mesoslip_elasticity_brick_coefficients_h

/** Numbers that describe the stiffness of a brick to the kernels. */
namespace mesoslip
{
constexpr unsigned int n_isotropic = 2;  ///< Lame's two
constexpr unsigned int n_cubes     = 4;  ///< of isotropic cubes: see cube_coefficients
constexpr unsigned int n_general   = 21; ///< the upper triangle of the Voigt matrix
} // namespace mesoslip

#endif
