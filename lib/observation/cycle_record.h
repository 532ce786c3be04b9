#ifndef mesoslip_observation_cycle_record_h
#define mesoslip_observation_cycle_record_h

#include <boost/serialization/vector.hpp>

#include <cstddef>
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
  explicit CycleRecord(const std::size_t capacity = 8192)
    : capacity(capacity)
  {
  }

  /** One sample; every sample has the same number of values, all finite. */
  void add(const std::vector<double> &values);

  /** Number of complete bins. */
  std::size_t size() const
  {
    return n_bins;
  }

  /** Number of samples in a bin. */
  unsigned long stride() const
  {
    return n_in_bin;
  }

  /** Values of a sample; 0 before the first one. */
  std::size_t n_columns() const
  {
    return width;
  }

  /** Mean of column @p c over the bins [first, last). */
  double mean(std::size_t c, std::size_t first, std::size_t last) const;

  /** Mean square about mean(), of the samples, not of the bins. */
  double variance(std::size_t c, std::size_t first, std::size_t last) const;

  /** Means of column @p c in all bins. */
  std::vector<double> column(std::size_t c) const;

  /** Saves or restores the record (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &width &n_bins &n_in_bin &means &variances;
    archive &n_pending &pending_mean &pending_square;
  }

private:
  void close_bin();
  void merge_pairs();

  std::size_t capacity;
  std::size_t width      = 0; ///< columns
  std::size_t n_bins     = 0;
  unsigned long n_in_bin = 1;
  std::vector<double> means, variances; ///< [bin][column]

  // The bin being filled (Welford's running mean and sum of squares).
  unsigned long n_pending = 0;
  std::vector<double> pending_mean, pending_square;
};
} // namespace mesoslip

#endif
