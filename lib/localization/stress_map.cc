#include "localization/stress_map.h"

namespace mesoslip
{
StressMap::StressMap(const UniformGrid<2> &grid,
                     const std::vector<std::uint8_t> &phase,
                     const std::vector<VoigtMatrix<2>> &stiffness,
                     const std::vector<double> &ratio,
                     const std::vector<double> &concentration)
  : the_grid(grid)
  , data(grid.cells[0], grid.cells[1], 10)
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

double mean_defect(const std::vector<double> &concentration)
{
  VoigtMatrix<2> sum = VoigtMatrix<2>::Zero();
  for (std::size_t k = 0; k < concentration.size(); k += 9)
    sum += Eigen::Map<const VoigtMatrix<2>>(concentration.data() + k);
  const std::size_t n_cells = concentration.size() / 9;
  return (sum / static_cast<double>(n_cells) - VoigtMatrix<2>::Identity())
    .cwiseAbs()
    .maxCoeff();
}
} // namespace mesoslip
