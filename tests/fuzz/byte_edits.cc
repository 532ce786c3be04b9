#include "byte_edits.h"

#include <algorithm>
#include <cstring>

namespace mesoslip_tests
{
std::string edit_bytes(std::string file, Choices &choices)
{
  while (!choices.empty() && !file.empty())
    {
      const unsigned int action = choices.below(16);
      const std::size_t at      = choices.place() % file.size();
      if (action == 0)
        file.resize(at); // cut off
      else if (action == 1)
        file.append(choices.byte(), static_cast<char>(choices.byte()));
      else if (action < 4) // a run of one value
        {
          const std::size_t n = std::min<std::size_t>(choices.byte(), file.size() - at);
          std::fill_n(file.begin() + static_cast<long>(at), n,
                      static_cast<char>(choices.byte()));
        }
      else if (action < 6) // a piece of the file elsewhere
        {
          const std::size_t from = choices.place() % file.size();
          const std::size_t n =
            std::min<std::size_t>(choices.byte(), file.size() - std::max(at, from));
          std::memmove(&file[at], &file[from], n);
        }
      else if (action < 8)
        file[at] = static_cast<char>(file[at] ^ (1 << choices.below(8)));
      else
        file[at] = static_cast<char>(choices.byte());
    }
  return file;
}
} // namespace mesoslip_tests
