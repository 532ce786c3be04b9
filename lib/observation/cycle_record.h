#ifndef mesoslip_observation_cycle_record_h
#define mesoslip_observation_cycle_record_h


#include <boost/serialization/vector.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * Uniformly sampled quantities of a run of any length in bounded memory: means and
 * variances of @p capacity / 2 to @p capacity bins of equal numbers of samples. Bins are
 * merged in pairs whenever the record is full, which loses neither means nor variances.
 */
class CycleRecord
{
public:
  /** @p capacity is even. */
  explicit CycleRecord(std::size_t capacity = 8192);

  /** One sample; every sample has the same number of values, all finite. */
  void add(const std::vector<double> &values);

  /** Complete bins. */
  std::size_t size() const
  {
    return n_bins_;
  }

  /** Samples in a bin. */
  unsigned long stride() const
  {
    return stride_;
  }

  /** Mean of @p column over the bins [first, last). */
  double mean(std::size_t column, std::size_t first, std::size_t last) const;

  /** Mean square about mean(), of the samples, not of the bins. */
  double variance(std::size_t column, std::size_t first, std::size_t last) const;

  /** Means of the bins from @p first on. */
  std::vector<double> column(std::size_t column, std::size_t first) const;

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &width_ &n_bins_ &stride_ &means_ &variances_ &pending_ &pending_mean_
      &pending_square_;
  }

private:
  void close_bin();
  void merge_pairs();

  std::size_t capacity_;
  std::size_t width_    = 0;
  std::size_t n_bins_   = 0;
  unsigned long stride_ = 1;
  std::vector<double> means_, variances_; // [bin][column]

  // The bin being filled (Welford's running mean and sum of squares).
  unsigned long pending_ = 0;
  std::vector<double> pending_mean_, pending_square_;
};
} // namespace mesoslip

#endif
