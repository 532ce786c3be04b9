#ifndef mesoslip_localization_stress_map_h
#define mesoslip_localization_stress_map_h

#include "grid/nodal_field.h"
#include "grid/uniform_grid.h"
#include "material/voigt.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * From the macroscopic strain of each cell to its local stress: sigma = C_phase L eps
 * (eqs 23 and 24). The product is formed once; with it goes the ratio of sigma_zz to
 * sigma_xx + sigma_yy in plane strain.
 */
class StressMap
{
public:
  /**
   * @p phase holds n_cells ids, @p stiffness (Pa) and @p ratio one entry for each phase,
   * @p concentration the tensors L [ny][nx][3][3]; empty: the identity, which leaves
   * sigma = C_phase eps, the stress of a run that resolves the phases.
   */
  StressMap(const UniformGrid<2> &grid,
            const std::vector<std::uint8_t> &phase,
            const std::vector<VoigtMatrix<2>> &stiffness,
            const std::vector<double> &ratio,
            const std::vector<double> &concentration);

  /** Of the RVE. */
  const UniformGrid<2> &grid() const
  {
    return the_grid;
  }

  /** C_phase L of row @p j: 9 arrays at distances of stride(), row-major. */
  const double *matrix_row(const std::size_t j) const
  {
    return data.row(0, j);
  }

  /** sigma_zz / (sigma_xx + sigma_yy) of row @p j. */
  const double *ratio_row(const std::size_t j) const
  {
    return data.row(9, j);
  }

  /** Numbers from one of the nine arrays of a row to the next. */
  std::size_t stride() const
  {
    return data.component_stride();
  }

  /** C_phase L (Pa) of one cell. */
  VoigtMatrix<2> matrix(const unsigned int i, const unsigned int j) const;

private:
  UniformGrid<2> the_grid;
  NodalField<double> data;
};

/**
 * Largest entry of (mean of L) - I over all cells of [..][3][3] tensors: zero, up to the
 * accuracy of the solver, for KUBC and PBC.
 */
double mean_defect(const std::vector<double> &concentration);
} // namespace mesoslip

#endif
