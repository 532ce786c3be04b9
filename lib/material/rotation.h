#ifndef mesoslip_material_rotation_h
#define mesoslip_material_rotation_h

#include "material/voigt.h"

namespace mesoslip
{
/**
 * The stiffness of the same solid turned counter-clockwise by @p angle (rad) about z,
 * in the old axes. A quarter turn swaps xx and yy.
 */
VoigtMatrix<2> rotate_stiffness(const VoigtMatrix<2> &stiffness, const double angle);

} // namespace mesoslip

#endif
