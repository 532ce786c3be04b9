#include "statics/voxel/level.h"

#include "elasticity/brick/brick_matrices.h"
#include "grid/instruction_set.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace mesoslip::voxel
{
namespace
{
constexpr unsigned int n_power_iterations = 12;
/** On coarse grids, where they cost little: their polynomials, of a higher degree, grow
 *  faster beyond the largest eigenvalue, and the preconditioner is no longer definite if that
 *  is 2 % off. */
constexpr unsigned int n_coarse_power_iterations = 60;
constexpr double coarse_cells                    = 3e5;
/** What a power iteration of so few steps falls short of. */
constexpr double safety = 1.12;
} // namespace

const Kernels &kernels()
{
  using Tables                 = const Kernels &(*)();
  const Tables tables[]        = MESOSLIP_VARIANTS(kernels);
  static const Kernels &chosen = variant(tables, InstructionSet::automatic)();
  return chosen;
}

Level::Level(const VoxelGrid &the_grid, CellStiffness &&the_stiffness)
  : grid(the_grid)
  , stiffness(std::move(the_stiffness))
  , inverse(grid)
{
  set_inverse_diagonal();
  estimate_largest_eigenvalue();
}

SweepArguments<float> Level::arguments(VoxelField<float> &x)
{
  SweepArguments<float> a = sweep_arguments(grid, work);
  a.x                     = x.data();
  a.stiffness             = stiffness.numbers.data();
  a.inverse               = inverse.data();
  return a;
}

double Level::product(VoxelField<float> &x, VoxelField<float> &out)
{
  SweepArguments<float> a = arguments(x);
  a.out                   = out.data();
  return sum_over_ranks(grid,
                        kernels().product[stiffness.n_coefficients == n_general](a));
}

void Level::residual(VoxelField<float> &x,
                     const VoxelField<float> &b,
                     VoxelField<float> &out)
{
  SweepArguments<float> a = arguments(x);
  a.b                     = b.data();
  a.out                   = out.data();
  kernels().residual[stiffness.n_coefficients == n_general](a);
}

void Level::smooth(const Smoothing &smoothing,
                   const bool from_zero,
                   VoxelField<float> &x,
                   const VoxelField<float> &b,
                   VoxelField<float> &d)
{
  const double centre = 0.5 * largest * (1. + smoothing.range),
               radius = 0.5 * largest * (1. - smoothing.range), sigma = centre / radius;
  SweepArguments<float> a = arguments(x);
  a.b                     = b.data();
  a.d                     = d.data();
  double rho              = 1. / sigma;
  for (unsigned int step = 0; step < smoothing.degree; ++step)
    {
      if (step == 0)
        {
          a.keep = 0.F;
          a.step = static_cast<float>(1. / centre);
        }
      else
        {
          const double next = 1. / (2. * sigma - rho);
          a.keep            = static_cast<float>(next * rho);
          a.step            = static_cast<float>(2. * next / radius);
          rho               = next;
        }
      if (step == 0 && from_zero)
        {
          kernels().first_step(x.size(), a.step, inverse.data(), b.data(), x.data(),
                               d.data());
          x.set_ghosts();
        }
      else
        {
          kernels().chebyshev[stiffness.n_coefficients == n_general](a);
          x.set_ghost_rows();
        }
    }
}

/** The diagonal is the sum of those of the eight cells around a node. */
void Level::set_inverse_diagonal()
{
  const unsigned int n                    = stiffness.n_coefficients;
  const std::vector<BrickMatrix> matrices = brick_matrices(grid.spacing, n);
  const unsigned int nx = grid.n_nodes(0), ny = grid.n_nodes(1), nz = grid.n_nodes(2);
  for (unsigned int k = 1; k <= nz; ++k)
    for (unsigned int j = 1; j <= ny; ++j)
      for (unsigned int c = 0; c < 3; ++c)
        {
          float *out = inverse.row(c, j, k);
          for (unsigned int corner = 0; corner < 8; ++corner)
            for (unsigned int m = 0; m < n; ++m)
              {
                // The node is this corner of the cell that begins one before, or at it.
                const unsigned int back = corner & 1U;
                const float *cells =
                  stiffness.row(grid, m, j - (corner >> 1 & 1U), k - (corner >> 2));
                const auto weight =
                  static_cast<float>(matrices[m](3 * corner + c, 3 * corner + c));
                for (unsigned int i = 1; i <= nx; ++i)
                  out[i] += weight * cells[i - back];
              }
          for (unsigned int i = 1; i <= nx; ++i)
            out[i] = 1.F / out[i];
        }
}

void Level::estimate_largest_eigenvalue()
{
  VoxelField<float> x(grid), d(grid), q(grid);
  for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
    {
      // The same for any number of ranks.
      std::uint32_t state = 2654435761U * (grid.below() + k);
      for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int i = 1; i <= grid.n_nodes(0); ++i)
            {
              state             = 1664525U * state + 1013904223U;
              x.row(c, j, k)[i] = static_cast<float>(state >> 8) / 16777216.F - 0.5F;
            }
    }
  const auto norm_of_x = [&]() {
    return std::sqrt(sum_over_ranks(grid, kernels().dot(x.size(), x.data(), x.data())));
  };
  const bool few = 1. * grid.cells[0] * grid.cells[1] * grid.cells[2] <= coarse_cells;
  const unsigned int n = few ? n_coarse_power_iterations : n_power_iterations;
  double norm          = norm_of_x();
  for (unsigned int i = 0; i < n && norm > 0.; ++i)
    {
      x.set_ghosts();
      product(x, q);
      kernels().first_step(x.size(), static_cast<float>(1. / norm), inverse.data(),
                           q.data(), x.data(), d.data());
      norm    = norm_of_x();
      largest = safety * norm;
    }
}
} // namespace mesoslip::voxel
