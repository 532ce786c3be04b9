#include "observation/phase_diagram.h"

#include "observation/spectrum.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mesoslip
{
namespace
{
constexpr double crossing_hysteresis = 0.2; ///< of the standard deviation
constexpr double shortest_period     = 0.6; ///< of the one expected
constexpr unsigned int bins          = 200; ///< of the phase

double at(const std::vector<double> &signal, const double position)
{
  const auto i   = std::min(static_cast<std::size_t>(position), signal.size() - 2);
  const double s = position - static_cast<double>(i);
  return (1. - s) * signal[i] + s * signal[i + 1];
}

/**
 * One period of @p signal, from sample position @p begin to @p end, by bins: the mean of
 * the samples in a bin, or the interpolated value at its centre if it holds none.
 */
std::vector<double>
fold(const std::vector<double> &signal, const double begin, const double end)
{
  std::vector<double> sum(bins, 0.);
  std::vector<unsigned int> count(bins, 0);
  for (auto i = static_cast<std::size_t>(std::ceil(begin)); static_cast<double>(i) < end;
       ++i)
    {
      const double phase = (static_cast<double>(i) - begin) / (end - begin);
      const auto bin     = std::min(static_cast<unsigned int>(phase * bins), bins - 1);
      sum[bin] += signal[i];
      ++count[bin];
    }
  for (unsigned int bin = 0; bin < bins; ++bin)
    sum[bin] = count[bin] > 0 ? sum[bin] / count[bin]
                              : at(signal, begin + (bin + 0.5) / bins * (end - begin));
  return sum;
}

/** Mean and standard deviation over the rows of @p periods, column by column. */
void average(const std::vector<std::vector<double>> &periods,
             std::vector<double> &mean,
             std::vector<double> &spread)
{
  const double n = static_cast<double>(periods.size());
  mean.assign(periods.front().size(), 0.);
  spread.assign(periods.front().size(), 0.);
  for (const auto &row : periods)
    for (std::size_t i = 0; i < row.size(); ++i)
      mean[i] += row[i] / n;
  if (periods.size() < 2)
    return;
  for (const auto &row : periods)
    for (std::size_t i = 0; i < row.size(); ++i)
      spread[i] += (row[i] - mean[i]) * (row[i] - mean[i]) / (n - 1.);
  for (double &value : spread)
    value = std::sqrt(value);
}
/**
 * Times, in units of samples, at which @p signal crosses @p level upwards (linear
 * interpolation). A crossing counts only after the signal has been below level -
 * hysteresis, and only the first one within @p minimum_distance samples.
 */
std::vector<double> upward_crossings(const std::vector<double> &signal,
                                     const double level,
                                     const double hysteresis,
                                     const double minimum_distance)
{
  std::vector<double> crossings;
  bool armed = false;
  for (std::size_t i = 1; i < signal.size(); ++i)
    {
      const double before = signal[i - 1] - level, now = signal[i] - level;
      armed = armed || before < -hysteresis;
      if (!(armed && before < 0. && now >= 0.))
        continue;
      armed                 = false;
      const double position = static_cast<double>(i - 1) - before / (now - before);
      if (crossings.empty() || position - crossings.back() >= minimum_distance)
        crossings.push_back(position);
    }
  return crossings;
}
} // namespace

PhaseDiagram mean_phase_diagram(const std::vector<double> &displacement,
                                const std::vector<double> &velocity,
                                const double time_step,
                                const double expected_period)
{
  AssertDimension(displacement.size(), velocity.size());
  PhaseDiagram diagram;
  double period = expected_period;
  if (!(period > 0.))
    {
      const auto summary =
        summarize_spectrum(amplitude_spectrum(displacement, time_step));
      if (!summary)
        return diagram;
      period = 1. / summary->main_frequency;
    }

  double mean = 0., square = 0.;
  for (const double value : displacement)
    mean += value / static_cast<double>(displacement.size());
  for (const double value : displacement)
    square += (value - mean) * (value - mean) / static_cast<double>(displacement.size());
  const auto crossings =
    upward_crossings(displacement, mean, crossing_hysteresis * std::sqrt(square),
                     shortest_period * period / time_step);
  if (crossings.size() < 2)
    return diagram;

  std::vector<std::vector<double>> displacements, velocities;
  for (std::size_t k = 0; k + 1 < crossings.size(); ++k)
    {
      displacements.push_back(fold(displacement, crossings[k], crossings[k + 1]));
      velocities.push_back(fold(velocity, crossings[k], crossings[k + 1]));
    }
  diagram.n_periods = static_cast<unsigned int>(displacements.size());
  average(displacements, diagram.displacement, diagram.displacement_spread);
  average(velocities, diagram.velocity, diagram.velocity_spread);
  return diagram;
}
} // namespace mesoslip
