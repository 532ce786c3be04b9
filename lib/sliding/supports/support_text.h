#ifndef mesoslip_sliding_supports_support_text_h
#define mesoslip_sliding_supports_support_text_h

#include "sliding/contact_parameters.h"

#include <string>

namespace mesoslip
{
/** The key Kind of a side: free, pressure, platen, held, springs or absorbing. */
std::string kind_of(const SideSupport &side, const unsigned int dim);

/** "Left: springs of 1e+12, 0 Pa/m; a pressure of 2e+06 Pa" with all digits; for the top
 * without its pressure. Empty for a side without supports and loads. */
std::string support_text(const SideSupport &side, const unsigned int dim);

/** support_text() of top and sides, joined. */
std::string support_texts(const ContactParameters &parameters);
} // namespace mesoslip

#endif
