#ifndef mesoslip_material_plausibility_h
#define mesoslip_material_plausibility_h

#include "material/phase.h"

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * What looks like a modulus typed in another unit than Pa: a phase softer than soft
 * rubber (1 MPa), or one more than a million times as stiff as another; one sentence,
 * empty if there is nothing to say. Stiffness is the larger of D11 and D22.
 */
std::string stiffness_warning(const std::vector<Phase<2>> &phases);
} // namespace mesoslip

#endif
