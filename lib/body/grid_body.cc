#include "body/grid_body.h"

#include "body/strain_modes.h"

namespace mesoslip
{
std::vector<VoigtMatrix<2>>
GridBody<2>::strain_products(const NodalField<double> &u) const
{
  const UniformGrid<2> &grid = material.grid();
  std::vector<VoigtMatrix<2>> products(phases().size(), VoigtMatrix<2>::Zero());
  StrainModes<2, 1> modes(grid.spacing);
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const unsigned int phase = material.phase_of(i, j);
        for (unsigned int corner = 0; corner < 4; ++corner)
          for (unsigned int c = 0; c < 2; ++c)
            modes.displacement(corner, c)[0] =
              u(c, NodeIndex{i + corner % 2, j + corner / 2});
        modes.visit(phases()[phase].mean_dilatation, grid.cell_measure(),
                    [&](const double volume, const VoigtVector<2> &strain) {
                      products[phase] += volume * strain * strain.transpose();
                    });
      }
  return products;
}

std::vector<MatrixEntry> GridBody<2>::stiffness_entries() const
{
  const UniformGrid<2> &grid = material.grid();
  std::vector<Eigen::Matrix<double, 8, 8>> of_phases;
  for (const ElasticPhase<2> &phase : phases())
    of_phases.push_back(cell_stiffness(phase, {{grid.spacing[0], grid.spacing[1]}}));
  std::vector<MatrixEntry> entries;
  entries.reserve(64 * grid.n_cells());
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const Eigen::Matrix<double, 8, 8> &K = of_phases[material.phase_of(i, j)];
        const auto number                    = [&](const unsigned int k) {
          const std::uint64_t node =
            static_cast<std::uint64_t>(j + k / 4) * n_columns() + i + k / 2 % 2;
          return 2 * node + k % 2;
        };
        for (unsigned int r = 0; r < 8; ++r)
          for (unsigned int c = 0; c < 8; ++c)
            entries.push_back({number(r), number(c), K(r, c)});
      }
  return entries;
}
} // namespace mesoslip
