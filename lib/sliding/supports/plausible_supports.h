#ifndef mesoslip_sliding_supports_plausible_supports_h
#define mesoslip_sliding_supports_plausible_supports_h

#include "material/plausibility.h"
#include "sliding/contact_parameters.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Range for contact springs with key @p key: the pressure compresses them by at most a
 * hundredth of the height. */
PlausibleRange plausible_springs(const std::string &key,
                                 const double stiffness,
                                 const ContactParameters &parameters,
                                 const double height);

/** Ranges of supports: springs stretch by less than a thousand heights under the pressure
 * on the top and are less than a million times as stiff as the body; dashpots have at
 * most a thousand times its impedance, a platen at most ten thousand times its mass. */
std::vector<PlausibleRange> plausible_suspension(const ContactParameters &parameters,
                                                 const SideSupport &side,
                                                 const BodyScales &scales);
} // namespace mesoslip

#endif
