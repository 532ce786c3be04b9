#include "observation/contact_statistics.h"

#include <deal.II/base/exceptions.h>

#include <boost/math/distributions/students_t.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace mesoslip
{
namespace
{
constexpr unsigned int most_batches = 20, batches_without_period = 10;

/** The samples of the window, from first to the last one, and equal batches at its end. */
struct Batches
{
  double begin = 0., end = 0.;
  double length       = 0.; ///< s; of a batch
  unsigned int number = 0;
  std::size_t first   = 0; ///< sample
};

/** Divides whole periods into batches, counted backwards from the last sample. */
Batches choose_batches(const std::vector<double> &time, const MeanWindow &window)
{
  const double period = window.period;
  const auto start    = std::lower_bound(time.begin(), time.end(), window.from);
  Assert(time.end() - start >= 3, dealii::ExcMessage("There are fewer than 3 samples."));
  Batches batches;
  batches.end   = time.back();
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

/** Mean rates of a cumulative quantity in the batches, the last one first. */
std::vector<double> batch_rates(const std::vector<double> &time,
                                const std::vector<double> &cumulative,
                                const Batches &batches)
{
  std::vector<double> rates;
  for (unsigned int b = 0; b < batches.number; ++b)
    {
      const double end   = batches.end - b * batches.length;
      const double begin = std::max(batches.begin, end - batches.length);
      rates.push_back(
        (interpolated(time, cumulative, end) - interpolated(time, cumulative, begin)) /
        (end - begin));
    }
  return rates;
}

/** @p value with its error from the deviation of the batch means. */
Estimate estimate_of(const double value,
                     const std::vector<double> &batch_means,
                     const Batches &batches)
{
  Estimate estimate = {value, 0., batches.number, batches.begin, batches.end};
  if (batches.number < 2)
    return estimate;
  const double mean =
    std::accumulate(batch_means.begin(), batch_means.end(), 0.) / batches.number;
  double square = 0.;
  for (const double x : batch_means)
    square += (x - mean) * (x - mean);
  const double deviation = std::sqrt(square / (batches.number - 1));
  estimate.half_width =
    boost::math::quantile(boost::math::students_t(batches.number - 1), 0.975) *
    (deviation / std::sqrt(batches.number));
  return estimate;
}

double least_squares_slope(const std::vector<double> &x,
                           const std::vector<double> &y,
                           const Batches &batches)
{
  const double n = static_cast<double>(x.size() - batches.first);
  double mean_x = 0., mean_y = 0., product = 0., square = 0.;
  for (std::size_t i = batches.first; i < x.size(); ++i)
    {
      mean_x += x[i] / n;
      mean_y += y[i] / n;
    }
  for (std::size_t i = batches.first; i < x.size(); ++i)
    {
      product += (x[i] - mean_x) * (y[i] - mean_y);
      square += (x[i] - mean_x) * (x[i] - mean_x);
    }
  return product / square;
}

} // namespace

std::size_t
first_block(const std::vector<NodeCounts> &blocks, const double dt, const double from)
{
  const auto inside = [&](const NodeCounts &block) {
    return block.first_step * dt >= from - 1e-9 * block.n_steps * dt;
  };
  const auto found = std::find_if(blocks.begin(), blocks.end() - 1, inside);
  return static_cast<std::size_t>(found - blocks.begin());
}

NodeMeans mean_loads(const std::vector<NodeCounts> &blocks,
                     const std::size_t first,
                     const std::size_t last,
                     const std::vector<double> &area,
                     const double dt)
{
  AssertIndexRange(last, blocks.size());
  double n_steps = 0.;
  for (std::size_t b = first; b <= last; ++b)
    n_steps += static_cast<double>(blocks[b].n_steps);
  const auto difference = [&](std::vector<double> NodeLoads::*sums, const std::size_t i) {
    const double before = first == 0 ? 0. : (blocks[first - 1].loads.*sums)[i];
    return (blocks[last].loads.*sums)[i] - before;
  };
  NodeMeans means;
  for (std::size_t i = 0; i < area.size(); ++i)
    {
      means.pressure.push_back(difference(&NodeLoads::normal_force, i) /
                               (n_steps * area[i]));
      means.friction_power.push_back(difference(&NodeLoads::friction_energy, i) /
                                     (n_steps * dt * area[i]));
    }
  return means;
}

ContactSummary summarize_contact(const std::vector<NodeCounts> &blocks,
                                 const std::size_t n,
                                 const double dt,
                                 const double from)
{
  Assert(!blocks.empty(), dealii::ExcMessage("There is no block."));
  const std::size_t first = first_block(blocks, dt, from);
  double steps            = 0.;
  std::vector<double> stick(n, 0.), slip(n, 0.), landings(n, 0.);
  for (std::size_t b = first; b < blocks.size(); ++b)
    {
      steps += static_cast<double>(blocks[b].n_steps);
      for (std::size_t i = 0; i < n; ++i)
        {
          stick[i] += blocks[b].stick[i];
          slip[i] += blocks[b].slip[i];
          landings[i] += blocks[b].landings[i];
        }
    }

  ContactSummary summary;
  const double end       = (blocks.back().first_step + blocks.back().n_steps) * dt;
  const double time_step = (end - blocks[first].first_step * dt) / steps;
  const double n_nodes   = static_cast<double>(n);
  double contact_time = 0., episodes = 0., landed = 0.;
  for (std::size_t i = 0; i < n; ++i)
    {
      const ContactShares shares = {slip[i] / steps, stick[i] / steps,
                                    (steps - slip[i] - stick[i]) / steps};
      summary.node_shares.push_back(shares);
      summary.shares.slip += shares.slip;
      summary.shares.stick += shares.stick;
      summary.shares.separation += shares.separation;
      contact_time += (slip[i] + stick[i]) * time_step;
      episodes += landings[i];
      landed += landings[i] > 0. ? 1. : 0.;
    }
  for (double *share :
       {&summary.shares.slip, &summary.shares.stick, &summary.shares.separation})
    *share /= n_nodes;
  summary.duration = {episodes > 0. ? contact_time / episodes : contact_time,
                      landed / n_nodes};
  return summary;
}

std::string regime_label(const ContactShares &shares)
{
  const double threshold = 0.01;
  const bool slips       = shares.slip >= threshold;
  const bool sticks      = shares.stick >= threshold;
  const bool separates   = shares.separation >= threshold;
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

Estimate mean_power(const std::vector<double> &time,
                    const std::vector<double> &work,
                    const MeanWindow &window)
{
  AssertDimension(time.size(), work.size());
  const Batches batches = choose_batches(time, window);
  return estimate_of(least_squares_slope(time, work, batches),
                     batch_rates(time, work, batches), batches);
}

Estimate interface_friction_coefficient(const std::vector<double> &time,
                                        const std::vector<double> &friction_energy,
                                        const std::vector<double> &load_work,
                                        const MeanWindow &window)
{
  AssertDimension(time.size(), friction_energy.size());
  const Estimate load = mean_power(time, load_work, window);
  Assert(load.value > 0., dealii::ExcMessage("There is no load."));
  const Batches batches = choose_batches(time, window);
  const double value = least_squares_slope(time, friction_energy, batches) / load.value;
  // Uses the deviation of the friction of a batch from its load, so that a varying load
  // does not count as an error.
  std::vector<double> means       = batch_rates(time, friction_energy, batches);
  const std::vector<double> loads = batch_rates(time, load_work, batches);
  for (std::size_t b = 0; b < means.size(); ++b)
    means[b] = (means[b] - value * loads[b]) / load.value;
  return estimate_of(value, means, batches);
}

Estimate window_mean(const std::vector<double> &time,
                     const std::vector<double> &values,
                     const MeanWindow &window)
{
  AssertDimension(time.size(), values.size());
  std::vector<double> integral(time.size(), 0.);
  for (std::size_t i = 1; i < time.size(); ++i)
    integral[i] =
      integral[i - 1] + 0.5 * (values[i] + values[i - 1]) * (time[i] - time[i - 1]);
  const Batches batches           = choose_batches(time, window);
  const std::vector<double> means = batch_rates(time, integral, batches);
  Batches whole                   = batches;
  whole.number                    = 1;
  whole.length                    = whole.end - whole.begin;
  return estimate_of(batch_rates(time, integral, whole)[0], means, batches);
}

std::vector<double> quotients(const std::vector<double> &tangential,
                              const std::vector<double> &normal)
{
  std::vector<double> ratio(std::min(tangential.size(), normal.size()));
  for (std::size_t k = 0; k < ratio.size(); ++k)
    ratio[k] = normal[k] != 0. ? tangential[k] / normal[k] : 0.;
  return ratio;
}
} // namespace mesoslip
