#ifndef mesoslip_material_stiffness_derivatives_h
#define mesoslip_material_stiffness_derivatives_h

#include "material/stiffness.h"

#include <array>

namespace mesoslip
{
/** Derivatives of isotropic_stiffness<3>() with respect to Young's modulus [-] and to
 * Poisson's ratio (Pa). */
std::array<VoigtMatrix<3>, 2> isotropic_derivatives(const double young_modulus,
                                                    const double poisson_ratio);

/**
 * Derivatives of orthotropic_stiffness<3>() with respect to its constants in their
 * order: [-] for the moduli, Pa for Poisson's ratios. Computed from the derivatives of
 * the compliance, dC = -C dS C.
 */
std::array<VoigtMatrix<3>, 9>
orthotropic_derivatives(const OrthotropicConstants &constants);

/** The in-plane block x, y of a 3D stiffness: plane strain. */
VoigtMatrix<2> plane_part(const VoigtMatrix<3> &stiffness);
} // namespace mesoslip

#endif
