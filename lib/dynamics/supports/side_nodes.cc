#include "dynamics/supports/side_nodes.h"

#include <algorithm>
#include <numeric>

namespace mesoslip
{
namespace
{
double sum_of_first(const std::vector<double> &values, const std::size_t n)
{
  const auto end = static_cast<std::ptrdiff_t>(std::min(n, values.size()));
  return std::accumulate(values.begin(), values.begin() + end, 0.);
}
} // namespace

double SideNodes::whole_area(const std::size_t n) const
{
  return sum_of_first(area, n);
}

std::array<double, 3> SideNodes::whole_push(const std::size_t n) const
{
  std::array<double, 3> sums;
  for (unsigned int c = 0; c < 3; ++c)
    sums[c] = sum_of_first(push[c], n);
  return sums;
}

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
