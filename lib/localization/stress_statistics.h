#ifndef mesoslip_localization_stress_statistics_h
#define mesoslip_localization_stress_statistics_h

#include "grid/nodal_field.h"
#include "localization/row_kernels.h"
#include "localization/stress_map.h"

#include <vector>

namespace mesoslip
{
/** Which fields are wanted. */
struct FieldSelection
{
  bool von_mises = true; ///< mean over time
  bool mean      = true; ///< of each stress component
  bool deviation = true; ///< standard deviation of each component

  /** Whether there is anything to compute. */
  bool any() const
  {
    return von_mises || mean || deviation;
  }
};

/** Statistics over time for each cell; what was not asked for is empty. */
struct StressFields
{
  /** Pa, [ny][nx]: time average of the von Mises stress. */
  std::vector<double> mean_von_mises;
  /** Pa, [ny][nx][3]: xx, yy, xy. */
  std::vector<double> mean_stress;
  /** Pa, [ny][nx][3]: standard deviation (divided by the number of samples). */
  std::vector<double> deviation_stress;
  std::size_t n_samples = 0; ///< that the averages are over
};

/**
 * Averages over time of the stresses of all cells, fed row by row; the memory does not
 * depend on the number of samples. The map must outlive the object.
 */
class StressStatistics
{
public:
  /** No samples yet; @p stress_map must outlive it. */
  StressStatistics(const StressMap &stress_map, const FieldSelection &fields);

  /** The next sample of row @p j, as the macroscopic strain of its cells. */
  void add(const std::size_t j, const ConstRow &strain);

  /** Every row must have been given the same number of samples, at least one. */
  StressFields fields() const;

private:
  /** Arrays of a row. */
  enum : unsigned int
  {
    von_mises = 0,
    mean      = 1,
    squares   = 4
  };

  std::vector<double> interleaved(const unsigned int first, const bool as_root) const;

  const StressMap &map;
  FieldSelection selection;
  std::vector<std::size_t> samples;
  NodalField<double> sums;
  /** One row: the stress and a work array. */
  NodalField<double> scratch;
};
} // namespace mesoslip

#endif
