#include "localization/comparison/series_comparison.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Mean and standard deviation (divided by n) of component @p c of a series. */
std::array<double, 2> mean_and_deviation(const std::vector<double> &values,
                                         const unsigned int c)
{
  const double n = static_cast<double>(values.size()) / 3.;
  double mean = 0., squares = 0.;
  for (std::size_t k = c; k < values.size(); k += 3)
    mean += values[k];
  mean /= n;
  for (std::size_t k = c; k < values.size(); k += 3)
    squares += (values[k] - mean) * (values[k] - mean);
  return {{mean, std::sqrt(squares / n)}};
}

double relative(const double value, const double reference)
{
  return reference != 0. ? (value - reference) / reference : ComponentStatistics::unknown;
}
} // namespace

std::vector<double> resample(const ProbeSeries &series, const std::vector<double> &times)
{
  std::vector<double> values;
  values.reserve(3 * times.size());
  std::size_t next = 1;
  for (const double t : times)
    {
      while (next + 1 < series.time.size() && series.time[next] < t)
        ++next;
      const std::size_t last  = std::min(next, series.time.size() - 1);
      const std::size_t first = last == 0 ? 0 : last - 1;
      const double span       = series.time[last] - series.time[first];
      const double share =
        span > 0. ? std::clamp((t - series.time[first]) / span, 0., 1.) : 0.;
      for (unsigned int c = 0; c < 3; ++c)
        values.push_back((1. - share) * series.values[3 * first + c] +
                         share * series.values[3 * last + c]);
    }
  return values;
}

std::array<ComponentStatistics, 3> compare_series(const std::vector<double> &stress,
                                                  const std::vector<double> &direct,
                                                  const std::vector<double> &resampled)
{
  std::array<ComponentStatistics, 3> result;
  for (unsigned int c = 0; c < 3; ++c)
    {
      ComponentStatistics &r = result[c];
      const auto ours        = mean_and_deviation(stress, c);
      r.mean                 = ours[0];
      r.deviation            = ours[1];
      if (direct.empty())
        continue;
      const auto theirs  = mean_and_deviation(direct, c);
      r.direct_mean      = theirs[0];
      r.direct_deviation = theirs[1];
      r.error_mean       = relative(r.mean, r.direct_mean);
      r.error_deviation  = relative(r.deviation, r.direct_deviation);
      double difference = 0., norm = 0.;
      for (std::size_t k = c; k < resampled.size(); k += 3)
        {
          difference += (stress[k] - resampled[k]) * (stress[k] - resampled[k]);
          norm += resampled[k] * resampled[k];
        }
      if (norm > 0.)
        r.rms_difference = std::sqrt(difference / norm);
    }
  return result;
}
} // namespace mesoslip
