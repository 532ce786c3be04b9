#ifndef mesoslip_exchange_time_window_h
#define mesoslip_exchange_time_window_h

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace mesoslip
{
/** Interval from begin to end (s), both included up to round-off. */
struct TimeWindow
{
  double begin = -std::numeric_limits<double>::infinity(); ///< first time
  double end   = std::numeric_limits<double>::infinity();  ///< last time

  /** Intersection of both windows; begin > end if it is empty. */
  TimeWindow intersection(const TimeWindow &other) const
  {
    return {std::max(begin, other.begin), std::min(end, other.end)};
  }
};

/** Index range first, ..., first + count - 1. */
struct IndexRange
{
  std::size_t first = 0; ///< index of the first entry
  std::size_t count = 0; ///< number of entries
};

/** Indices of ascending @p times inside the window. */
IndexRange entries_in(const std::vector<double> &times, const TimeWindow &window);

/** Elements of @p all inside the range. */
std::vector<double> times_of(const std::vector<double> &all, const IndexRange &range);

/** Strain or stress at a probe over time. */
struct ProbeSeries
{
  std::vector<double> time;   ///< s
  std::vector<double> values; ///< Voigt components [k][3 or 6]
};
} // namespace mesoslip

#endif
