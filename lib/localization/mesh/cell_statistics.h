#ifndef mesoslip_localization_mesh_cell_statistics_h
#define mesoslip_localization_mesh_cell_statistics_h

#include "localization/stress_statistics.h"

#include <vector>

namespace mesoslip
{
/** How the cells of a volume answer to macroscopic strain, eqs 22 to 24. */
template <int dim>
struct LocalCells
{
  std::vector<VoigtMatrix<dim>> stiffness; ///< C_phase L of each cell (Pa)

  /** sigma_zz / (sigma_xx + sigma_yy) of each cell; not used in 3D. */
  std::vector<double> ratio;
};

/** Von Mises stress (Pa), in 2D with sigma_zz = @p ratio (sigma_xx + sigma_yy). */
template <int dim>
double von_mises(const VoigtVector<dim> &stress, const double ratio);

/**
 * Averages over time of the stresses of cells; the memory does not depend on the number
 * of samples. The cells must outlive the object.
 */
template <int dim>
class CellStatistics
{
public:
  /** No samples yet. */
  CellStatistics(const LocalCells<dim> &cells, const FieldSelection &fields);

  /** The next sample: @p strain (k) is the macroscopic strain of cell number k. */
  template <typename Strain>
  void add(const Strain &strain)
  {
    ++n_samples;
    for (std::size_t k = 0; k < cells.stiffness.size(); ++k)
      add_stress(k, cells.stiffness[k] * strain(k));
  }

  /** Fields [n], [n][components] of the cells; one sample at least is needed. */
  StressFields fields() const;

private:
  void add_stress(const std::size_t k, const VoigtVector<dim> &stress);

  const LocalCells<dim> &cells;
  const FieldSelection selection;
  std::size_t n_samples = 0;
  std::vector<double> von_mises_sum;
  std::vector<VoigtVector<dim>> mean, squares; ///< running mean, squared deviations
};
} // namespace mesoslip

#endif
