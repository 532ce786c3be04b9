#ifndef mesoslip_sliding_supports_plausible_supports_h
#define mesoslip_sliding_supports_plausible_supports_h

#include "material/plausibility.h"
#include "sliding/contact_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Springs between body and flat, called @p key, that the pressure moves by a hundredth of the height at most. */
PlausibleRange plausible_springs(const std::string &key,
                                 const double stiffness,
                                 const ContactParameters &parameters,
                                 const double height);

/** Springs that the pressure on the top does not stretch by a thousand heights, and that are not a million times as stiff
 * as the body; dashpots of a thousand times its impedance, and a platen of ten thousand times its mass at most. */
std::vector<PlausibleRange> plausible_suspension(const ContactParameters &parameters,
                                                 const SideSupport &side,
                                                 const BodyScales &scales);
} // namespace mesoslip

#endif
