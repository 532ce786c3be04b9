#ifndef mesoslip_localization_comparison_series_comparison_h
#define mesoslip_localization_comparison_series_comparison_h

#include "exchange/dynamics_file.h"

#include <array>
#include <limits>
#include <vector>

namespace mesoslip
{
/** One stress component of a probe; NaN where there is nothing to say. */
struct ComponentStatistics
{
  /** Not a number. */
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  double mean             = unknown; ///< of the localized series (Pa)
  double deviation        = unknown; ///< standard deviation (Pa)
  double direct_mean      = unknown; ///< of the direct series, at its own samples (Pa)
  double direct_deviation = unknown; ///< standard deviation of the direct one (Pa)
  /**
   * localized / direct - 1: negative when too small in magnitude. They do not ask whether
   * the two series are in step: limit cycles of two runs have arbitrary phases.
   */
  double error_mean      = unknown;
  double error_deviation = unknown; ///< of the standard deviations
  /** rms of the difference at equal times, relative to the rms of the direct series. */
  double rms_difference = unknown;
};

/**
 * Linear interpolation of a series at @p times, which lie within its own up to round-off.
 * A series of one sample holds at all times.
 */
std::vector<double> resample(const ProbeSeries &series, const std::vector<double> &times);

/**
 * @p stress [k][3] against @p direct; @p resampled [k][3] is the latter at the times of
 * the former. An empty direct series leaves all but mean and deviation unknown.
 */
std::array<ComponentStatistics, 3> compare_series(const std::vector<double> &stress,
                                                  const std::vector<double> &direct,
                                                  const std::vector<double> &resampled);
} // namespace mesoslip

#endif
