#ifndef mesoslip_sliding_supports_support_text_h
#define mesoslip_sliding_supports_support_text_h

#include "sliding/contact_parameters.h"

#include <string>

namespace mesoslip
{
/** "Left: springs of 1e+12, 0 Pa/m; a pressure of 2e+06 Pa" with all digits; of the top without its
 * pressure. Empty where there is nothing. */
std::string support_text(const SideSupport &side, const unsigned int dim);

/** The same of top and sides, one after the other. */
std::string support_texts(const ContactParameters &parameters);
} // namespace mesoslip

#endif
