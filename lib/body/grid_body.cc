#include "body/grid_body.h"

#include <Eigen/Dense>

namespace mesoslip
{
namespace
{
/** Constant-strain and hourglass part of a cell with the sides @p h (m); nodes lower left, lower
 * right, upper left, upper right, x and y of each in turn. */
Eigen::Matrix<double, 8, 8> cell_stiffness(const VoigtMatrix<2> &D,
                                           const std::array<double, 2> &h)
{
  Eigen::Matrix<double, 3, 8> B = Eigen::Matrix<double, 3, 8>::Zero();
  Eigen::Matrix<double, 2, 8> G = Eigen::Matrix<double, 2, 8>::Zero();
  for (Eigen::Index k = 0; k < 4; ++k)
    {
      const double dx = (k % 2 == 0 ? -0.5 : 0.5) / h[0],
                   dy = (k < 2 ? -0.5 : 0.5) / h[1], alternating = k % 3 == 0 ? 1. : -1.;
      B(0, 2 * k) = B(2, 2 * k + 1) = dx;
      B(1, 2 * k + 1) = B(2, 2 * k) = dy;
      G(0, 2 * k) = G(1, 2 * k + 1) = alternating;
    }
  Eigen::Matrix2d H;
  const double xx = h[0] * h[0], yy = h[1] * h[1], mixed = D(0, 2) / xx + D(1, 2) / yy;
  H << D(0, 0) / xx + D(2, 2) / yy, mixed, mixed, D(1, 1) / yy + D(2, 2) / xx;
  return h[0] * h[1] * (B.transpose() * D * B + G.transpose() * H * G / 12.);
}
} // namespace

std::vector<MatrixEntry> GridBody<2>::stiffness_entries() const
{
  const UniformGrid<2> &grid = material.grid();
  std::vector<Eigen::Matrix<double, 8, 8>> of_phases;
  for (const ElasticPhase<2> &phase : phases())
    of_phases.push_back(
      cell_stiffness(phase.stiffness, {{grid.spacing[0], grid.spacing[1]}}));
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
