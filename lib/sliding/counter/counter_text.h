#ifndef mesoslip_sliding_counter_counter_text_h
#define mesoslip_sliding_counter_counter_text_h

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
} // namespace mesoslip

#endif
