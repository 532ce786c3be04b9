#include "exchange/time_window.h"

#include <cmath>

namespace mesoslip
{
IndexRange entries_in(const std::vector<double> &times, const TimeWindow &window)
{
  // Infinite ends have no slack.
  const auto slack = [](const double t) { return std::isfinite(t) ? 1e-9 * t : 0.; };
  if (!(window.begin <= window.end))
    return {};
  const auto from = std::lower_bound(times.begin(), times.end(),
                                     window.begin - std::fabs(slack(window.begin)));
  const auto to =
    std::upper_bound(from, times.end(), window.end + std::fabs(slack(window.end)));
  return {static_cast<std::size_t>(from - times.begin()),
          static_cast<std::size_t>(to - from)};
}

std::vector<double> times_of(const std::vector<double> &all, const IndexRange &range)
{
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(range.first);
  return {first, first + static_cast<std::ptrdiff_t>(range.count)};
}
} // namespace mesoslip
