#ifndef mesoslip_sliding_counter_counter_text_h
#define mesoslip_sliding_counter_counter_text_h

#include "dynamics/supports/side_support.h"

#include <string>

namespace mesoslip
{
/** Text for a counter body: "Counter body: 12 x 8 cells" from "Body: 12 x 8 cells"; other
 * lines get the prefix. */
inline std::string text_of_counter(const std::string &line)
{
  const std::string start = "Body: ";
  return "Counter body: " +
         (line.rfind(start, 0) == 0 ? line.substr(start.size()) : line);
}

/** Mirrors a support between the upright and the upside-down body, along the last axis of
 * @p dim. The function is its own inverse. */
SideSupport turned_over(SideSupport side, const unsigned int dim);
} // namespace mesoslip

#endif
