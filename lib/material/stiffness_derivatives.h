#ifndef mesoslip_material_stiffness_derivatives_h
#define mesoslip_material_stiffness_derivatives_h

#include "material/stiffness.h"

#include <array>

namespace mesoslip
{
/** Derivatives of isotropic_stiffness<3>() with respect to Young's modulus [-] and to Poisson's ratio (Pa). */
std::array<VoigtMatrix<3>, 2> isotropic_derivatives(const double young_modulus,
                                                    const double poisson_ratio);

/**
 * Derivatives of orthotropic_stiffness<3>() with respect to its constants in their order: [-] for the moduli,
 * Pa for Poisson's ratios. From those of the compliance, dC = -C dS C.
 */
std::array<VoigtMatrix<3>, 9>
orthotropic_derivatives(const OrthotropicConstants &constants);

/** What is in the plane x, y of a stiffness in space: plane strain. */
VoigtMatrix<2> plane_part(const VoigtMatrix<3> &stiffness);
} // namespace mesoslip

#endif
