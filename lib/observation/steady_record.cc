#include "observation/steady_record.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Columns of the record of the contact. */
enum RecordColumn : std::size_t
{
  displacement,
  velocity,
  friction_energy, ///< since the previous sample
  load_work,       ///< since the previous sample
  apparent_friction,
  n_columns
};

double ratio(const double tangential, const double normal)
{
  return normal != 0. ? tangential / normal : 0.;
}

/** Sums of all samples up to the end of each bin. */
std::vector<double> running_sum(const CycleRecord &record, const std::size_t column)
{
  std::vector<double> sums = record.column(column);
  double sum               = 0.;
  for (double &value : sums)
    value = sum += value * static_cast<double>(record.stride());
  return sums;
}
} // namespace

void CycleRecord::add(const std::vector<double> &values)
{
  if (n_pending == 0)
    {
      width = values.size();
      pending_mean.assign(width, 0.);
      pending_square.assign(width, 0.);
    }
  AssertDimension(values.size(), width);
  const double share = 1. / static_cast<double>(++n_pending);
  for (std::size_t c = 0; c < width; ++c)
    {
      const double difference = values[c] - pending_mean[c];
      pending_mean[c] += difference * share;
      pending_square[c] += difference * (values[c] - pending_mean[c]);
    }
  if (n_pending == n_in_bin)
    close_bin();
}

void CycleRecord::close_bin()
{
  for (std::size_t c = 0; c < width; ++c)
    {
      means.push_back(pending_mean[c]);
      variances.push_back(pending_square[c] / static_cast<double>(n_pending));
    }
  n_pending = 0;
  if (++n_bins == capacity)
    merge_pairs();
}

void CycleRecord::merge_pairs()
{
  for (std::size_t bin = 0; bin < n_bins / 2; ++bin)
    for (std::size_t c = 0; c < width; ++c)
      {
        const std::size_t to = bin * width + c, a = 2 * bin * width + c, b = a + width;
        const double half_difference = 0.5 * (means[b] - means[a]);
        variances[to] =
          0.5 * (variances[a] + variances[b]) + half_difference * half_difference;
        means[to] = means[a] + half_difference;
      }
  n_bins /= 2;
  means.resize(n_bins * width);
  variances.resize(n_bins * width);
  n_in_bin *= 2;
}

double CycleRecord::mean(const std::size_t c,
                         const std::size_t first,
                         const std::size_t last) const
{
  // Relative to the first value, so that a small vibration on a large mean keeps its
  // accuracy.
  const double origin = means[first * width + c];
  double sum          = 0.;
  for (std::size_t bin = first; bin < last; ++bin)
    sum += means[bin * width + c] - origin;
  return origin + sum / static_cast<double>(last - first);
}

double CycleRecord::variance(const std::size_t c,
                             const std::size_t first,
                             const std::size_t last) const
{
  const double center = mean(c, first, last);
  double sum          = 0.;
  for (std::size_t bin = first; bin < last; ++bin)
    {
      const double difference = means[bin * width + c] - center;
      sum += variances[bin * width + c] + difference * difference;
    }
  return sum / static_cast<double>(last - first);
}

std::vector<double> CycleRecord::column(const std::size_t c) const
{
  std::vector<double> values;
  for (std::size_t bin = 0; bin < n_bins; ++bin)
    values.push_back(means[bin * width + c]);
  return values;
}

std::size_t SteadySeries::first(const double from) const
{
  return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), from) -
                                  time.begin());
}

SteadyRecord::SteadyRecord(const unsigned int interval,
                           const double dt,
                           const std::size_t capacity)
  : interval(interval)
  , dt(dt)
  , contact(capacity)
  , top(capacity)
{
}

void SteadyRecord::add(const ContactHistory &fresh)
{
  std::vector<double> values(n_columns);
  for (std::size_t k = 0; k < fresh.time.size(); ++k)
    {
      values[displacement]      = fresh.nodes[0].ux[k];
      values[velocity]          = fresh.nodes[0].vx[k];
      values[friction_energy]   = fresh.friction_energy[k] - last_friction_energy;
      values[load_work]         = fresh.load_work[k] - last_load_work;
      values[apparent_friction] = ratio(fresh.tangential_force[k], fresh.normal_force[k]);
      last_friction_energy      = fresh.friction_energy[k];
      last_load_work            = fresh.load_work[k];
      contact.add(values);
    }
}

void SteadyRecord::add(const TopHistory &fresh)
{
  for (std::size_t k = 0; k < fresh.normal_force.size(); ++k)
    top.add({ratio(fresh.tangential_force[k], fresh.normal_force[k])});
}

SteadySeries SteadyRecord::series() const
{
  SteadySeries s;
  s.interval = static_cast<double>(contact.stride()) * interval * dt;
  for (std::size_t bin = 0; bin < contact.size(); ++bin)
    s.time.push_back(static_cast<double>(((bin + 1) * contact.stride() - 1) * interval) *
                     dt);
  if (contact.size() == 0)
    return s;
  s.displacement      = contact.column(displacement);
  s.velocity          = contact.column(velocity);
  s.friction_energy   = running_sum(contact, friction_energy);
  s.load_work         = running_sum(contact, load_work);
  s.apparent_friction = contact.column(apparent_friction);
  for (std::size_t bin = 0; bin < contact.size(); ++bin)
    s.displacement_variance.push_back(contact.variance(displacement, bin, bin + 1));
  return s;
}

std::vector<double> SteadyRecord::top_friction() const
{
  return top.size() > 0 ? top.column(0) : std::vector<double>();
}

double SteadyRecord::numbers(const double n_samples)
{
  return 2. * (n_columns + 1) *
         std::min(n_samples, static_cast<double>(default_capacity));
}
} // namespace mesoslip
