#include "observation/friction_summary.h"

#include "io/errors.h"

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
constexpr unsigned int most_batches = 20, batches_without_period = 10;

/** Samples [first, last] of the window and the equal batches at its end. */
struct Batches
{
  double begin = 0., end = 0.;
  double length       = 0.; ///< s; of a batch
  unsigned int number = 0;
  std::size_t first = 0, last = 0;
};

/** Whole periods, counted backwards from the last sample not after @p to. */
Batches choose_batches(const std::vector<double> &time,
                       const double from,
                       const double to,
                       const double period)
{
  const auto after = std::upper_bound(time.begin(), time.end(), to);
  const auto start = std::lower_bound(time.begin(), time.end(), from);
  if (after - start < 3)
    {
      std::ostringstream text;
      text << "fewer than three samples lie between " << from << " s and " << to
           << " s: simulate longer or begin the statistics earlier";
      throw UserError(text.str());
    }
  Batches batches;
  batches.end   = *(after - 1);
  batches.begin = *start;
  const double periods =
    period > 0. ? std::floor((batches.end - batches.begin) / period * (1. + 1e-9)) : 0.;
  if (periods >= 1.)
    {
      const double in_a_batch = std::ceil(periods / most_batches);
      batches.begin           = std::max(batches.begin, batches.end - periods * period);
      batches.length          = in_a_batch * period;
      batches.number          = static_cast<unsigned int>(periods / in_a_batch);
    }
  else
    {
      batches.number = period > 0. ? 1 : batches_without_period;
      batches.length = (batches.end - batches.begin) / batches.number;
    }
  batches.last  = static_cast<std::size_t>(after - time.begin()) - 1;
  batches.first = static_cast<std::size_t>(
    std::lower_bound(time.begin(), time.end(), batches.begin) - time.begin());
  return batches;
}

double interpolated(const std::vector<double> &time,
                    const std::vector<double> &values,
                    const double t)
{
  const auto upper = std::lower_bound(time.begin(), time.end(), t);
  if (upper == time.begin())
    return values.front();
  if (upper == time.end())
    return values.back();
  const auto i   = static_cast<std::size_t>(upper - time.begin());
  const double s = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return (1. - s) * values[i - 1] + s * values[i];
}

/** Mean rate of a cumulative quantity over the window, its error by batches. */
Estimate batch_rates(const std::vector<double> &time,
                     const std::vector<double> &cumulative,
                     const Batches &batches)
{
  const auto rate = [&](const double begin, const double end) {
    return (interpolated(time, cumulative, end) - interpolated(time, cumulative, begin)) /
           (end - begin);
  };
  Estimate estimate;
  estimate.value   = rate(batches.begin, batches.end);
  estimate.batches = batches.number;
  estimate.begin   = batches.begin;
  estimate.end     = batches.end;
  if (batches.number < 2)
    return estimate;
  std::vector<double> rates(batches.number);
  for (unsigned int b = 0; b < batches.number; ++b)
    rates[b] = rate(std::max(batches.begin, batches.end - (b + 1) * batches.length),
                    batches.end - b * batches.length);
  const double mean = std::accumulate(rates.begin(), rates.end(), 0.) / batches.number;
  double square     = 0.;
  for (const double x : rates)
    square += (x - mean) * (x - mean);
  estimate.batch_deviation = std::sqrt(square / (batches.number - 1));
  estimate.standard_error  = estimate.batch_deviation / std::sqrt(batches.number);
  estimate.half_width =
    boost::math::quantile(boost::math::students_t(batches.number - 1), 0.975) *
    estimate.standard_error;
  return estimate;
}

double least_squares_slope(const std::vector<double> &x,
                           const std::vector<double> &y,
                           const std::size_t first,
                           const std::size_t last)
{
  const double n = static_cast<double>(last - first + 1);
  double mean_x = 0., mean_y = 0., product = 0., square = 0.;
  for (std::size_t i = first; i <= last; ++i)
    {
      mean_x += x[i] / n;
      mean_y += y[i] / n;
    }
  for (std::size_t i = first; i <= last; ++i)
    {
      product += (x[i] - mean_x) * (y[i] - mean_y);
      square += (x[i] - mean_x) * (x[i] - mean_x);
    }
  return product / square;
}

void check_lengths(const std::vector<double> &time, const std::vector<double> &values)
{
  if (time.size() != values.size())
    throw std::invalid_argument("history: arrays of different lengths");
}
} // namespace

Estimate interface_friction_coefficient(const std::vector<double> &time,
                                        const std::vector<double> &friction_energy,
                                        const double from,
                                        const double to,
                                        const double period,
                                        const double reference_power)
{
  check_lengths(time, friction_energy);
  if (!(reference_power > 0.))
    throw UserError("the global interface friction coefficient needs a pressure and a "
                    "sliding velocity that are not zero");
  const Batches batches = choose_batches(time, from, to, period);
  Estimate estimate     = batch_rates(time, friction_energy, batches);
  estimate.value =
    least_squares_slope(time, friction_energy, batches.first, batches.last) /
    reference_power;
  estimate.batch_deviation /= reference_power;
  estimate.standard_error /= reference_power;
  estimate.half_width /= reference_power;
  return estimate;
}

Estimate window_mean(const std::vector<double> &time,
                     const std::vector<double> &values,
                     const double from,
                     const double to,
                     const double period)
{
  check_lengths(time, values);
  const Batches batches = choose_batches(time, from, to, period);
  std::vector<double> integral(time.size(), 0.);
  for (std::size_t i = 1; i < time.size(); ++i)
    integral[i] =
      integral[i - 1] + 0.5 * (values[i] + values[i - 1]) * (time[i] - time[i - 1]);
  return batch_rates(time, integral, batches);
}

std::string regime_label(const ContactShares &shares, const double threshold)
{
  if (!(shares.slip >= 0. && shares.stick >= 0. && shares.separation >= 0.) ||
      !(std::abs(shares.slip + shares.stick + shares.separation - 1.) <= 1e-6))
    throw std::invalid_argument("regime_label: shares have to sum to 1");
  const bool slips     = shares.slip >= threshold;
  const bool sticks    = shares.stick >= threshold;
  const bool separates = shares.separation >= threshold;
  if (slips && sticks)
    return separates ? "stick-slip-separation" : "stick-slip";
  if (slips && separates)
    return shares.slip >= shares.separation
             ? "slip-separation, regime 1 (mostly slipping)"
             : "slip-separation, regime 2 (mostly separated)";
  if (sticks && separates)
    return "stick-separation";
  return slips ? "permanent slip" : sticks ? "permanent stick" : "permanent separation";
}
} // namespace mesoslip
