#include "dynamics/supports/traction.h"

namespace mesoslip
{
void Traction::set(const unsigned int c, const std::string &text)
{
  static const std::vector<std::string> variables = {"x", "y", "z", "t"};
  components[c]                                   = std::make_shared<const Expression>(
    text, variables, "a traction is a function of x, y, z and the time t");
}
} // namespace mesoslip
