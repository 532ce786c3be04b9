#include "localization/stress_statistics.h"

#include <cmath>

namespace mesoslip
{
StressStatistics::StressStatistics(const StressMap &stress_map,
                                   const FieldSelection &fields)
  : map(stress_map)
  , selection(fields)
  , samples(map.grid().cells[1], 0)
  , sums(map.grid().cells[0],
         map.grid().cells[1],
         selection.deviation ? 7
         : selection.mean    ? 4
                             : 1)
  , scratch(map.grid().cells[0], 1, 4)
{
}

void StressStatistics::add(const std::size_t j, const ConstRow &strain)
{
  const std::size_t n = map.grid().cells[0];
  const Row stress    = {scratch.row(0, 0), scratch.row(1, 0), scratch.row(2, 0)};
  stress_row(map.matrix_row(j), map.stride(), strain, n, stress);
  const double inverse = 1. / static_cast<double>(++samples[j]);
  if (selection.von_mises)
    add_von_mises_row(stress, map.ratio_row(j), n, scratch.row(3, 0),
                      sums.row(von_mises, j));
  for (unsigned int c = 0; c < 3; ++c)
    if (selection.deviation)
      add_moments_row(scratch.row(c, 0), n, inverse, sums.row(mean + c, j),
                      sums.row(squares + c, j));
    else if (selection.mean)
      add_mean_row(scratch.row(c, 0), n, inverse, sums.row(mean + c, j));
}

std::vector<double> StressStatistics::interleaved(const unsigned int first,
                                                  const bool as_root) const
{
  const std::size_t nx = map.grid().cells[0], ny = map.grid().cells[1];
  std::vector<double> values(3 * nx * ny);
  double *out    = values.data();
  const double n = static_cast<double>(samples[0]);
  for (std::size_t j = 0; j < ny; ++j)
    for (std::size_t i = 0; i < nx; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double value = sums.row(first + c, j)[i];
          *out++             = as_root ? std::sqrt(value / n) : value;
        }
  return values;
}

StressFields StressStatistics::fields() const
{
  StressFields result;
  result.n_samples     = samples[0];
  const std::size_t nx = map.grid().cells[0];
  if (selection.von_mises)
    for (std::size_t j = 0; j < sums.n_rows(); ++j)
      for (std::size_t i = 0; i < nx; ++i)
        result.mean_von_mises.push_back(sums.row(von_mises, j)[i] /
                                        static_cast<double>(samples[j]));
  if (selection.mean)
    result.mean_stress = interleaved(mean, false);
  if (selection.deviation)
    result.deviation_stress = interleaved(squares, true);
  return result;
}
} // namespace mesoslip
