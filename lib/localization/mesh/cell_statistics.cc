#include "localization/mesh/cell_statistics.h"

#include <cmath>

namespace mesoslip
{
namespace
{
template <int dim>
std::vector<double> entries_of(const std::vector<VoigtVector<dim>> &values)
{
  std::vector<double> result;
  result.reserve(values.size() * n_voigt<dim>);
  for (const VoigtVector<dim> &value : values)
    result.insert(result.end(), value.data(), value.data() + value.size());
  return result;
}
} // namespace

template <>
double von_mises<2>(const VoigtVector<2> &stress, const double ratio)
{
  const double xx = stress[0], yy = stress[1], zz = ratio * (xx + yy);
  const double a = xx - yy, b = yy - zz, c = zz - xx;
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * stress[2] * stress[2]);
}

template <>
double von_mises<3>(const VoigtVector<3> &stress, const double)
{
  const double a = stress[0] - stress[1], b = stress[1] - stress[2],
               c = stress[2] - stress[0];
  return std::sqrt(0.5 * (a * a + b * b + c * c) + 3. * stress.tail<3>().squaredNorm());
}

template <int dim>
CellStatistics<dim>::CellStatistics(const LocalCells<dim> &of_cells,
                                    const FieldSelection &fields)
  : cells(of_cells)
  , selection(fields)
  , von_mises_sum(fields.von_mises ? cells.ratio.size() : 0, 0.)
  , mean(fields.mean || fields.deviation ? cells.ratio.size() : 0,
         VoigtVector<dim>::Zero())
  , squares(fields.deviation ? cells.ratio.size() : 0, VoigtVector<dim>::Zero())
{
}

// Running mean and squared deviations after Welford.
template <int dim>
void CellStatistics<dim>::add_stress(const std::size_t k, const VoigtVector<dim> &stress)
{
  if (selection.von_mises)
    von_mises_sum[k] += von_mises<dim>(stress, cells.ratio[k]);
  if (mean.empty())
    return;
  const VoigtVector<dim> before = stress - mean[k];
  mean[k] += before / static_cast<double>(n_samples);
  if (selection.deviation)
    squares[k] += before.cwiseProduct(stress - mean[k]);
}

template <int dim>
StressFields CellStatistics<dim>::fields() const
{
  const double n = static_cast<double>(n_samples);
  StressFields result;
  result.mean_von_mises = von_mises_sum;
  for (double &value : result.mean_von_mises)
    value /= n;
  if (selection.mean)
    result.mean_stress = entries_of<dim>(mean);
  if (selection.deviation)
    result.deviation_stress = entries_of<dim>(squares);
  for (double &value : result.deviation_stress)
    value = std::sqrt(value / n);
  return result;
}

template class CellStatistics<2>;
template class CellStatistics<3>;
} // namespace mesoslip
