#include "homogenization/loads/load_statistics.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Values closer than this are equal up to the solver's error. */
constexpr double rounding_of_solver = 1e-6;

/** Keeps the more extreme of two values and its place; @p sign selects minimum or
 * maximum. */
void keep_extreme(double &value,
                  std::array<double, 3> &place,
                  const double other,
                  const std::array<double, 3> &other_place,
                  const double sign)
{
  const double ahead = sign * (other - value),
               alike = rounding_of_solver * std::max(std::fabs(other), std::fabs(value));
  if (ahead > alike || (ahead >= -alike && other_place < place))
    place = other_place;
  if (ahead > 0.)
    value = other;
}
} // namespace

void Moments::add(const Moments &other)
{
  if (!(other.volume > 0.))
    return;
  if (!(volume > 0.))
    {
      *this = other;
      return;
    }
  const double sum = volume + other.volume, distance = other.mean - mean;
  mean += distance * other.volume / sum;
  squares += other.squares + distance * distance * volume * other.volume / sum;
  volume = sum;
  keep_extreme(minimum, minimum_at, other.minimum, other.minimum_at, -1.);
  keep_extreme(maximum, maximum_at, other.maximum, other.maximum_at, 1.);
}

double Moments::standard_deviation() const
{
  return volume > 0. ? std::sqrt(squares / volume) : 0.;
}

Moments moments_of_cell(const double value,
                        const double volume,
                        const std::array<double, 3> &centre)
{
  return {volume, value, 0., value, value, centre, centre};
}

Bins::Bins(const Moments &moments, const unsigned int n)
  : n(n)
  , lower(moments.minimum)
  , upper(moments.maximum)
{
  const double alike = rounding_of_solver * std::max(std::fabs(lower), std::fabs(upper));
  if (upper - lower > alike)
    return;
  const double middle = 0.5 * (lower + upper), half = alike > 0. ? alike : 1.;
  lower = middle - half;
  upper = middle + half;
}

unsigned int Bins::operator()(const double value) const
{
  const double place = n * (value - lower) / (upper - lower);
  return std::min(static_cast<unsigned int>(std::max(place, 0.)), n - 1);
}

std::vector<double> Bins::edges() const
{
  std::vector<double> ends;
  for (unsigned int k = 0; k <= n; ++k)
    ends.push_back(lower + (upper - lower) * k / n);
  return ends;
}
} // namespace mesoslip
