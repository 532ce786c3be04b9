#include "contact/flat/flat_profile.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
std::vector<std::string> variables_in(const unsigned int dim)
{
  return dim == 2 ? std::vector<std::string>{"x"} : std::vector<std::string>{"x", "y"};
}
} // namespace

ProfileExpression::ProfileExpression(const std::string &text, const unsigned int dim)
  : expression(text, variables_in(dim), "a profile is a function of the place")
  , in_space(dim == 3)
{
}

std::pair<std::size_t, double> ProfileAxis::locate(double x, const bool repeats) const
{
  if (at.size() == 1)
    return {0, 0.};
  const double length = at.back() - at.front();
  if (repeats)
    x -= length * std::floor((x - at.front()) / length);
  x = std::clamp(x, at.front(), at.back());
  // Initial guess for mostly equidistant grid points.
  const std::size_t last = at.size() - 2;
  std::size_t i =
    static_cast<std::size_t>((x - at.front()) / length * static_cast<double>(last + 1));
  i = std::min(i, last);
  if (x < at[i] || x > at[i + 1])
    i = std::min(last, static_cast<std::size_t>(
                         std::upper_bound(at.begin(), at.end(), x) - at.begin() - 1));
  return {i, (x - at[i]) / (at[i + 1] - at[i])};
}

ProfileTable::ProfileTable(const Points &points)
  : points(points)
{
  AssertDimension(points.height.size(), points.x.at.size() * points.y.at.size());
}

double ProfileTable::operator()(const double x, const double y) const
{
  const auto [i, along_x] = points.x.locate(x, points.repeats);
  const auto [j, along_y] = points.y.locate(y, points.repeats);
  const std::size_t n     = points.x.at.size();
  const auto in_row       = [&, i = i, share = along_x](const std::size_t row) {
    const double *h = points.height.data() + row * n + i;
    return share == 0. ? h[0] : (1. - share) * h[0] + share * h[1];
  };
  return along_y == 0. ? in_row(j) : (1. - along_y) * in_row(j) + along_y * in_row(j + 1);
}
} // namespace mesoslip
