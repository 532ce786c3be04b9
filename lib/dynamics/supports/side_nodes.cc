#include "dynamics/supports/side_nodes.h"

namespace mesoslip
{
SideNodes SideNodes::at(const std::vector<unsigned int> &numbers) const
{
  const auto chosen = [&](const std::vector<double> &values) {
    std::vector<double> result;
    for (std::size_t k = 0; k < numbers.size() && !values.empty(); ++k)
      result.push_back(numbers[k] == none ? 0. : values[numbers[k]]);
    return result;
  };
  SideNodes some;
  some.area = chosen(area);
  for (unsigned int c = 0; c < 3; ++c)
    {
      some.push[c]     = chosen(push[c]);
      some.position[c] = chosen(position[c]);
    }
  for (const std::vector<double> &component : impedance)
    some.impedance.push_back(chosen(component));
  return some;
}
} // namespace mesoslip
