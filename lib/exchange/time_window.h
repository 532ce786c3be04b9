#ifndef mesoslip_exchange_time_window_h
#define mesoslip_exchange_time_window_h

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace mesoslip
{
/** From begin to end (s), both included up to round-off. */
struct TimeWindow
{
  double begin = -std::numeric_limits<double>::infinity(); ///< first time
  double end   = std::numeric_limits<double>::infinity();  ///< last time

  /** Times in both; begin > end if there are none. */
  TimeWindow intersection(const TimeWindow &other) const
  {
    return {std::max(begin, other.begin), std::min(end, other.end)};
  }
};

/** Entries first, ..., first + count - 1. */
struct IndexRange
{
  std::size_t first = 0; ///< index of the first entry
  std::size_t count = 0; ///< number of entries
};

/** The entries of ascending @p times that lie in the window. */
inline IndexRange entries_in(const std::vector<double> &times, const TimeWindow &window)
{
  // Not scaled by an end at infinity.
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
} // namespace mesoslip

#endif
