#ifndef mesoslip_sliding_counter_counter_text_h
#define mesoslip_sliding_counter_counter_text_h

#include "dynamics/supports/side_support.h"

#include <string>

namespace mesoslip
{
/** "Counter body: 12 x 8 cells" of the line "Body: 12 x 8 cells", or of another one that is told of a counter body. */
inline std::string text_of_counter(const std::string &line)
{
  const std::string start = "Body: ";
  return "Counter body: " +
         (line.rfind(start, 0) == 0 ? line.substr(start.size()) : line);
}

/** A support of a body that is computed upside down, along its last axis of @p dim; or that of such a body as it was given. */
SideSupport turned_over(SideSupport side, const unsigned int dim);
} // namespace mesoslip

#endif
