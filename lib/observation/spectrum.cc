#include "observation/spectrum.h"

#include "base/errors.h"

#include <deal.II/base/exceptions.h>

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <stdexcept>

namespace mesoslip
{
namespace
{
constexpr double pi = 3.14159265358979323846;

constexpr double threshold = 0.1; ///< share of the main amplitude that is significant

/** @p signal without its least-squares line; all zeros if only round-off remains. */
std::vector<double> without_trend(const std::vector<double> &signal)
{
  const std::size_t n = signal.size();
  const double centre = 0.5 * static_cast<double>(n - 1);
  double mean = 0., largest = 0.;
  for (const double value : signal)
    {
      mean += value / static_cast<double>(n);
      largest = std::max(largest, std::abs(value));
    }
  double product = 0., square = 0.;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double x = static_cast<double>(i) - centre;
      product += x * (signal[i] - mean);
      square += x * x;
    }
  const double slope = product / square;
  if (!std::isfinite(slope))
    throw NumericalFailure("the signal to be transformed is not finite");

  std::vector<double> rest(n);
  double sum_of_squares = 0.;
  for (std::size_t i = 0; i < n; ++i)
    {
      rest[i] = signal[i] - mean - slope * (static_cast<double>(i) - centre);
      sum_of_squares += rest[i] * rest[i];
    }
  if (std::sqrt(sum_of_squares / static_cast<double>(n)) < 1e-13 * largest)
    std::fill(rest.begin(), rest.end(), 0.);
  return rest;
}

/** Vertex of the parabola through the logarithms of bin @p k and its neighbours. */
SpectralSummary interpolated_peak(const Spectrum &spectrum, const std::size_t k)
{
  const double spacing = spectrum.frequency[1] - spectrum.frequency[0];
  const auto &a        = spectrum.amplitude;
  SpectralSummary peak = {spectrum.frequency[k], a[k]};
  if (a[k - 1] > 0. && a[k + 1] > 0.)
    {
      const double left = std::log(a[k - 1]), middle = std::log(a[k]),
                   right     = std::log(a[k + 1]);
      const double curvature = left - 2. * middle + right;
      if (curvature < 0.)
        {
          const double offset = 0.5 * (left - right) / curvature;
          peak.main_frequency += offset * spacing;
          peak.main_amplitude = std::exp(middle - 0.25 * (left - right) * offset);
        }
    }
  return peak;
}

constexpr double crossing_hysteresis = 0.2; ///< share of the standard deviation
constexpr double shortest_period     = 0.6; ///< share of the expected period
constexpr unsigned int bins          = 200; ///< bins of the phase

/** The value of @p signal (at least four samples) by cubic interpolation. */
double at(const std::vector<double> &signal, const double position)
{
  const auto last      = static_cast<double>(signal.size() - 3),
             middle    = std::clamp(std::floor(position), 1., last);
  const double *before = signal.data() + static_cast<std::size_t>(middle) - 1;
  const double s       = position - middle;
  return before[0] * s * (s - 1.) * (2. - s) / 6. +
         before[1] * (s + 1.) * (s - 1.) * (s - 2.) / 2. +
         before[2] * (s + 1.) * s * (2. - s) / 2. +
         before[3] * (s + 1.) * s * (s - 1.) / 6.;
}

/**
 * Folds a period of @p signal, from sample position @p begin to @p end, into bins: the
 * mean of the samples in a bin, or, if bins hold fewer than two, the interpolated value
 * at the bin centre.
 */
std::vector<double>
fold(const std::vector<double> &signal, const double begin, const double end)
{
  std::vector<double> sum(bins, 0.);
  if (end - begin < 2. * bins)
    {
      for (unsigned int bin = 0; bin < bins; ++bin)
        sum[bin] = at(signal, begin + (bin + 0.5) / bins * (end - begin));
      return sum;
    }
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
    sum[bin] /= count[bin];
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

Spectrum amplitude_spectrum(const std::vector<double> &signal,
                            const double time_step,
                            const unsigned int padding)
{
  if (!(time_step > 0.))
    throw std::invalid_argument("amplitude_spectrum: the time step has to be positive");
  const std::size_t n = signal.size();
  if (n < 8)
    return {};

  std::size_t length = 8;
  while (length < n * std::max(padding, 1u))
    length *= 2;
  std::vector<double> windowed = without_trend(signal);
  windowed.resize(length, 0.);
  double gain = 0.;
  for (std::size_t i = 0; i < n; ++i)
    {
      const double hann = 0.5 * (1. - std::cos(2. * pi * (static_cast<double>(i) + 0.5) /
                                               static_cast<double>(n)));
      windowed[i] *= hann;
      gain += hann;
    }

  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> transform;
  fft.fwd(transform, windowed);

  const std::size_t n_bins = length / 2 + 1;
  Spectrum spectrum;
  spectrum.duration = static_cast<double>(n) * time_step;
  spectrum.frequency.resize(n_bins);
  spectrum.amplitude.resize(n_bins);
  for (std::size_t k = 0; k < n_bins; ++k)
    {
      const double sides = (k == 0 || k == n_bins - 1) ? 1. : 2.;
      spectrum.frequency[k] =
        static_cast<double>(k) / (static_cast<double>(length) * time_step);
      spectrum.amplitude[k] = sides * std::abs(transform[k]) / gain;
    }
  return spectrum;
}

double share_near_limit(const Spectrum &spectrum)
{
  const std::size_t n = spectrum.amplitude.size();
  double all = 0., high = 0.;
  for (std::size_t k = 1; k < n; ++k)
    {
      const double power = spectrum.amplitude[k] * spectrum.amplitude[k];
      all += power;
      if (10 * k >= 9 * (n - 1))
        high += power;
    }
  return all > 0. ? high / all : 0.;
}

std::optional<SpectralSummary> summarize_spectrum(const Spectrum &spectrum,
                                                  const double noise_floor)
{
  const auto &f    = spectrum.frequency;
  const auto &a    = spectrum.amplitude;
  std::size_t main = 0;
  double slow      = 0.;
  for (std::size_t k = 1; k + 1 < f.size(); ++k)
    if (f[k] < spectrum.lowest_frequency())
      slow = std::max(slow, a[k]);
    else if (a[k] > noise_floor && a[k] >= a[k - 1] && a[k] > a[k + 1] &&
             (main == 0 || a[k] > a[main]))
      main = k;
  if (main == 0)
    return std::nullopt;

  SpectralSummary summary = interpolated_peak(spectrum, main);
  summary.slow_amplitude  = slow;
  std::size_t last        = f.size() - 1;
  while (last > main && !(a[last] > threshold * summary.main_amplitude))
    --last;
  summary.highest_frequency = std::max(f[last], summary.main_frequency);
  return summary;
}

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
