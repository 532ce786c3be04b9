#include "localization/stress_statistics.h"

#include <cmath>

namespace mesoslip
{
namespace
{
/** Arrays of a row of sums. */
constexpr unsigned int von_mises_sum = 0, means = 1, squares = 4;
} // namespace

StressMap::StressMap(const UniformGrid<2> &grid,
                     const std::vector<std::uint8_t> &phase,
                     const std::vector<VoigtMatrix<2>> &stiffness,
                     const std::vector<double> &ratio,
                     const std::vector<double> &concentration)
  : data(grid.cells[0], grid.cells[1], 10)
{
  const std::size_t nx = grid.cells[0];
  for (std::size_t cell = 0; cell < grid.n_cells(); ++cell)
    {
      const std::size_t i = cell % nx, j = cell / nx;
      VoigtMatrix<2> product = stiffness[phase[cell]];
      if (!concentration.empty())
        product *=
          Eigen::Map<const VoigtMatrix<2>>(concentration.data() + 9 * cell).eval();
      for (unsigned int k = 0; k < 9; ++k)
        data.row(k, j)[i] = product(k / 3, k % 3);
      data.row(9, j)[i] = ratio[phase[cell]];
    }
}

VoigtMatrix<2> StressMap::matrix(const unsigned int i, const unsigned int j) const
{
  VoigtMatrix<2> result;
  for (unsigned int k = 0; k < 9; ++k)
    result(k / 3, k % 3) = data.row(k, j)[i];
  return result;
}

const std::vector<StressField> &stress_fields()
{
  static const std::vector<StressField> all = {
    {"mean_von_mises", &StressFields::mean_von_mises, {"mean_von_mises"}},
    {"mean_stress",
     &StressFields::mean_stress,
     {"mean_sigma_xx", "mean_sigma_yy", "mean_sigma_xy"}},
    {"deviation_stress",
     &StressFields::deviation_stress,
     {"deviation_sigma_xx", "deviation_sigma_yy", "deviation_sigma_xy"}}};
  return all;
}

StressStatistics::StressStatistics(const StressMap &stress_map,
                                   const FieldSelection &fields)
  : map(stress_map)
  , selection(fields)
  , samples(map.rows().n_rows(), 0)
  , sums(map.rows().n_columns(),
         map.rows().n_rows(),
         selection.deviation ? 7
         : selection.mean    ? 4
                             : 1)
  , scratch(map.rows().n_columns(), 1, 4)
{
}

void StressStatistics::add(const unsigned int j, const StrainRow &strain)
{
  const std::size_t n = scratch.n_columns();
  double *xx = scratch.row(0, 0), *yy = scratch.row(1, 0), *xy = scratch.row(2, 0);
  stress_row(map.rows().row(0, j), map.rows().component_stride(), strain[0], strain[1],
             strain[2], n, xx, yy, xy);
  const double inverse = 1. / static_cast<double>(++samples[j]);
  if (selection.von_mises)
    add_von_mises_row(xx, yy, xy, map.rows().row(9, j), n, scratch.row(3, 0),
                      sums.row(von_mises_sum, j));
  for (unsigned int c = 0; c < 3; ++c)
    if (selection.deviation)
      add_moments_row(scratch.row(c, 0), n, inverse, sums.row(means + c, j),
                      sums.row(squares + c, j));
    else if (selection.mean)
      add_mean_row(scratch.row(c, 0), n, inverse, sums.row(means + c, j));
}

/** Arrays first to first + n - 1 [ny][nx][n], or the roots of what they are a sample. */
std::vector<double> StressStatistics::interleaved(const unsigned int first,
                                                  const unsigned int n,
                                                  const bool as_root) const
{
  std::vector<double> values;
  const double n_samples = static_cast<double>(samples[0]);
  for (unsigned int j = 0; j < sums.n_rows(); ++j)
    for (std::size_t i = 0; i < sums.n_columns(); ++i)
      for (unsigned int c = first; c < first + n; ++c)
        {
          const double value = sums.row(c, j)[i];
          values.push_back(as_root ? std::sqrt(value / n_samples) : value);
        }
  return values;
}

StressFields StressStatistics::fields() const
{
  StressFields result;
  if (selection.von_mises)
    result.mean_von_mises = interleaved(von_mises_sum, 1, false);
  for (double &value : result.mean_von_mises)
    value /= static_cast<double>(samples[0]);
  if (selection.mean)
    result.mean_stress = interleaved(means, 3, false);
  if (selection.deviation)
    result.deviation_stress = interleaved(squares, 3, true);
  return result;
}
} // namespace mesoslip
