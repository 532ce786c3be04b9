#include "observation/cycle_record.h"

#include <deal.II/base/exceptions.h>

namespace mesoslip
{
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
  // About the first value, so that a small vibration on a large mean keeps its digits.
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
} // namespace mesoslip
