#ifndef mesoslip_elasticity_brick_coefficients_h
#define mesoslip_elasticity_brick_coefficients_h

/** Numbers that describe the stiffness of a brick to the kernels. */
namespace mesoslip
{
constexpr unsigned int n_isotropic = 2; ///< Lame's two
constexpr unsigned int n_cubes     = 4; ///< of isotropic cubes: see cube_coefficients
/** Of phases whose axes are those of the body: D11, D12, D13, D22, D23, D33, D44, D55, D66. */
constexpr unsigned int n_orthotropic = 9;

constexpr unsigned int n_plane = 6; ///< in the plane: the upper triangle of xx, zz, xz

constexpr unsigned int n_general = 21; ///< the upper triangle of the Voigt matrix

/** Numbers of a material in tables of many: n_general, and room up to whole cache lines. */
constexpr unsigned int n_of_material = 24;
} // namespace mesoslip

#endif
