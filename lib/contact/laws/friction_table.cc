#include "contact/laws/friction_table.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <utility>

namespace mesoslip
{
namespace
{
/**
 * Position of a number in an ascending list: between number i and the next one, at
 * fraction @p share; clamped at the ends.
 */
struct TablePlace
{
  TablePlace(const std::vector<double> &axis, const double x)
  {
    if (axis.size() < 2)
      return;
    const auto above = std::upper_bound(axis.begin() + 1, axis.end() - 1, x);
    i                = static_cast<std::size_t>(above - axis.begin()) - 1;
    width            = axis[i + 1] - axis[i];
    share            = std::clamp((x - axis[i]) / width, 0., 1.);
    inside           = x >= axis[i] && x < axis[i + 1];
  }

  std::size_t i = 0;
  double share = 0., width = 0.;
  bool inside = false;
};
} // namespace

FrictionTable::FrictionTable(Points points)
  : points(std::move(points))
{
  AssertDimension(this->points.coefficient.size(),
                  this->points.slip_rate.size() * this->points.pressure.size());
}

double FrictionTable::on_row(const std::size_t i, const SlipPoint &at) const
{
  const TablePlace place(points.pressure, at.pressure);
  const double *const row = points.coefficient.data() + i * points.pressure.size();
  return place.share > 0. ? row[place.i] + place.share * (row[place.i + 1] - row[place.i])
                          : row[place.i];
}

double FrictionTable::coefficient(const SlipPoint &at) const
{
  const TablePlace place(points.slip_rate, at.slip_rate);
  const double below = on_row(place.i, at);
  return place.share > 0. ? below + place.share * (on_row(place.i + 1, at) - below)
                          : below;
}

double FrictionTable::slope(const SlipPoint &at) const
{
  const TablePlace place(points.slip_rate, at.slip_rate);
  return place.inside ? (on_row(place.i + 1, at) - on_row(place.i, at)) / place.width
                      : 0.;
}

double FrictionTable::largest(const double) const
{
  return *std::max_element(points.coefficient.begin(), points.coefficient.end());
}

double FrictionTable::steepest_fall() const
{
  double fall         = 0.;
  const std::size_t m = points.pressure.size();
  for (std::size_t i = 0; i + 1 < points.slip_rate.size(); ++i)
    for (std::size_t j = 0; j < m; ++j)
      fall = std::max(
        fall, (points.coefficient[i * m + j] - points.coefficient[(i + 1) * m + j]) /
                (points.slip_rate[i + 1] - points.slip_rate[i]));
  return fall;
}
} // namespace mesoslip
