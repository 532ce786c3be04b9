#ifndef mesoslip_observation_steady_record_h
#define mesoslip_observation_steady_record_h

#include "contact/contact_recorder.h"
#include "dynamics/supports/top_surface.h"

#include <cstddef>
#include <vector>

namespace mesoslip
{
/**
 * Uniformly sampled quantities of a run of any length in bounded memory: means and
 * variances of @p capacity / 2 to @p capacity bins of equal numbers of samples. Bins are
 * merged in pairs when the record is full, which preserves means and variances.
 */
class CycleRecord
{
public:
  /** @p capacity must be even. */
  explicit CycleRecord(const std::size_t capacity = 8192)
    : capacity(capacity)
  {
  }

  /** Adds a sample; all samples have the same number of finite values. */
  void add(const std::vector<double> &values);

  /** Number of complete bins. */
  std::size_t size() const
  {
    return n_bins;
  }

  /** Samples per bin. */
  unsigned long stride() const
  {
    return n_in_bin;
  }

  /** Values per sample; 0 before the first sample. */
  std::size_t n_columns() const
  {
    return width;
  }

  /** Mean of column @p c over the bins [first, last). */
  double mean(std::size_t c, std::size_t first, std::size_t last) const;

  /** Mean square deviation of the samples (not of the bins) from mean(). */
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
  std::size_t width      = 0; ///< number of columns
  std::size_t n_bins     = 0;
  unsigned long n_in_bin = 1;
  std::vector<double> means, variances; ///< [bin][column]

  // The bin being filled (Welford's running mean and sum of squares).
  unsigned long n_pending = 0;
  std::vector<double> pending_mean, pending_square;
};

/**
 * Series for the statistics of the steady part, at equal intervals of time. In a long
 * run a value represents several samples: accumulated sums are exact at #time, all else
 * is their mean.
 */
struct SteadySeries
{
  double interval = 0.;                  ///< s; between two values
  std::vector<double> time;              ///< s; time of the last sample of a value
  std::vector<double> displacement;      ///< m; u_x of the reference node
  std::vector<double> velocity;          ///< m/s; v_x of the reference node
  std::vector<double> friction_energy;   ///< J/m; since the start
  std::vector<double> load_work;         ///< J/m; integral of F_N |V| since the start
  std::vector<double> apparent_friction; ///< F_T / F_N; 0 without normal force

  /** m^2; variance of the samples within a value. */
  std::vector<double> displacement_variance;

  /** Index of the first value at or after the time @p from (s). */
  std::size_t first(const double from) const;
};

/**
 * Samples for the statistics, at intervals independent of the histories. Memory is
 * bounded: when it is full, neighbouring values are replaced by their mean.
 */
class SteadyRecord
{
public:
  /** A sample every @p interval steps of @p dt seconds; @p capacity must be even. */
  SteadyRecord(const unsigned int interval,
               const double dt,
               const std::size_t capacity = default_capacity);

  /** Adds new samples of the contact; the reference node is its first monitored node. */
  void add(const ContactHistory &fresh);

  /** Adds new samples of the top. */
  void add(const TopHistory &fresh);

  /** Series of the contact, with the apparent friction of the contact forces. */
  SteadySeries series() const;

  /** Apparent friction at the top; same length as series(). */
  std::vector<double> top_friction() const;

  /** Numbers stored for @p n_samples samples, means and variances. */
  static double numbers(const double n_samples);

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &contact &top &last_friction_energy &last_load_work;
  }

private:
  static constexpr std::size_t default_capacity = 1 << 20;

  unsigned int interval;
  double dt;
  CycleRecord contact, top;
  double last_friction_energy = 0., last_load_work = 0.;
};
} // namespace mesoslip

#endif
