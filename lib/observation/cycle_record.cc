#include "observation/cycle_record.h"

#include <algorithm>
#include <stdexcept>

namespace mesoslip
{
CycleRecord::CycleRecord(const std::size_t capacity)
  : capacity_(capacity)
{
}

void CycleRecord::add(const std::vector<double> &values)
{
  if (width_ == 0)
    {
      width_ = values.size();
      pending_mean_.assign(width_, 0.);
      pending_square_.assign(width_, 0.);
    }
  if (values.size() != width_)
    throw std::invalid_argument("CycleRecord: samples of different lengths");
  const double share = 1. / static_cast<double>(++pending_);
  for (std::size_t c = 0; c < width_; ++c)
    {
      const double difference = values[c] - pending_mean_[c];
      pending_mean_[c] += difference * share;
      pending_square_[c] += difference * (values[c] - pending_mean_[c]);
    }
  if (pending_ == stride_)
    close_bin();
}

void CycleRecord::close_bin()
{
  for (std::size_t c = 0; c < width_; ++c)
    {
      means_.push_back(pending_mean_[c]);
      variances_.push_back(pending_square_[c] / static_cast<double>(pending_));
    }
  pending_ = 0;
  std::fill(pending_mean_.begin(), pending_mean_.end(), 0.);
  std::fill(pending_square_.begin(), pending_square_.end(), 0.);
  if (++n_bins_ == capacity_)
    merge_pairs();
}

void CycleRecord::merge_pairs()
{
  for (std::size_t bin = 0; bin < n_bins_ / 2; ++bin)
    for (std::size_t c = 0; c < width_; ++c)
      {
        const std::size_t to = bin * width_ + c, a = 2 * bin * width_ + c, b = a + width_;
        const double half_difference = 0.5 * (means_[b] - means_[a]);
        variances_[to] =
          0.5 * (variances_[a] + variances_[b]) + half_difference * half_difference;
        means_[to] = means_[a] + half_difference;
      }
  n_bins_ /= 2;
  means_.resize(n_bins_ * width_);
  variances_.resize(n_bins_ * width_);
  stride_ *= 2;
}

double CycleRecord::mean(const std::size_t column,
                         const std::size_t first,
                         const std::size_t last) const
{
  // About the first value, so that a small vibration on a large mean keeps its digits.
  const double origin = means_[first * width_ + column];
  double sum          = 0.;
  for (std::size_t bin = first; bin < last; ++bin)
    sum += means_[bin * width_ + column] - origin;
  return origin + sum / static_cast<double>(last - first);
}

double CycleRecord::variance(const std::size_t column,
                             const std::size_t first,
                             const std::size_t last) const
{
  const double center = mean(column, first, last);
  double sum          = 0.;
  for (std::size_t bin = first; bin < last; ++bin)
    {
      const double difference = means_[bin * width_ + column] - center;
      sum += variances_[bin * width_ + column] + difference * difference;
    }
  return sum / static_cast<double>(last - first);
}

std::vector<double> CycleRecord::column(const std::size_t column,
                                        const std::size_t first) const
{
  std::vector<double> values;
  for (std::size_t bin = first; bin < n_bins_; ++bin)
    values.push_back(means_[bin * width_ + column]);
  return values;
}
} // namespace mesoslip
