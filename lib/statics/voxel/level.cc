#include "statics/voxel/level.h"

#include "elasticity/brick/brick_matrices.h"
#include "grid/instruction_set.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace mesoslip::voxel
{
namespace
{
constexpr unsigned int n_power_iterations = 12;
/** Iterations on coarse grids, where they are cheap. Polynomials of higher degree grow
 * faster beyond the largest eigenvalue: with an error of 2 % the preconditioner is no
 * longer definite. */
constexpr unsigned int n_coarse_power_iterations = 60;
constexpr double coarse_cells                    = 3e5;
/** Compensates the underestimate of a power iteration with few steps. */
constexpr double safety = 1.12;
/** Edges with a smaller relative difference are equal. */
constexpr double equal_edges = 1e-14;
} // namespace

const Kernels &kernels()
{
  using Tables                 = const Kernels &(*)();
  const Tables tables[]        = MESOSLIP_VARIANTS(kernels);
  static const Kernels &chosen = variant(tables, InstructionSet::automatic)();
  return chosen;
}

Cells cells_of(const VoxelGrid &grid, const unsigned int n_coefficients)
{
  switch (n_coefficients)
    {
    case n_plane:
      return Cells::flat;
    case n_plane_apart:
      return Cells::flat_apart;
    case n_general:
      return Cells::general;
    case n_general_apart:
      return Cells::general_apart;
    case n_isotropic_apart:
      return Cells::isotropic_apart;
    default:
      break;
    }
  for (const unsigned int axis : {0U, 2U})
    if (std::abs(grid.ratio(axis) - 1.) > equal_edges)
      return Cells::isotropic;
  return Cells::cubes;
}

Level::Level(const VoxelGrid &the_grid,
             CellStiffness &&the_stiffness,
             const HeldComponents &held)
  : grid(the_grid)
  , stiffness(std::move(the_stiffness))
  , cells(cells_of(grid, stiffness.n_coefficients))
{
  set_inverse_diagonal();
  hold(held);
  estimate_largest_eigenvalue();
}

void Level::hold(const HeldComponents &held, const Springs &by_springs)
{
  for (; !replaced.empty(); replaced.pop_back())
    inverse[replaced.back().first] = replaced.back().second;
  held_places.clear();
  take_springs(by_springs);
  if (held.size() == 0)
    return;
  for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
    for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
      for (unsigned int c = 0; c < grid.n_components(); ++c)
        {
          const float *row = held.row(c, j, k);
          for (unsigned int i = 1; i <= grid.n_nodes(0); ++i)
            if (row[i] > 0.F)
              held_places.push_back(static_cast<std::size_t>(row - held.data()) + i);
        }
  for (const std::size_t place : held_places)
    {
      replaced.emplace_back(place, inverse[place]);
      inverse[place] = 0.F; // no step changes these
    }
}

void Level::take_springs(const Springs &given)
{
  all_springs.clear();
  if (given.direct.size() == 0)
    return;
  for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
    for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
      for (unsigned int i = 1; i <= grid.n_nodes(0); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int e = 0; e < 3; ++e)
            {
              const float entry = c == e ? given.direct.row(c, j, k)[i]
                                         : given.mixed.row(3 - c - e, j, k)[i];
              const auto place  = [&](const unsigned int component) {
                return static_cast<std::size_t>(given.direct.row(component, j, k) -
                                                given.direct.data()) +
                       i;
              };
              if (entry != 0.F)
                all_springs.push_back({place(c), place(e), entry});
            }
  for (const Spring &spring : all_springs)
    if (spring.row == spring.column)
      {
        float &x = inverse[spring.row];
        replaced.emplace_back(spring.row, x);
        x = 1.F / (1.F / x + spring.stiffness);
      }
  if (!all_springs.empty() && left.size() == 0)
    left = VoxelField<float>(grid);
}

void Level::add_forces_of_springs(const VoxelField<float> &x,
                                  VoxelField<float> &forces) const
{
  for (const Spring &spring : all_springs)
    forces.data()[spring.row] -= spring.stiffness * x.data()[spring.column];
}

/** A Chebyshev step with the factors in @p step. */
void Level::step_on_springs(const SweepArguments<float> &step,
                            VoxelField<float> &x,
                            const VoxelField<float> &b,
                            VoxelField<float> &d)
{
  residual(x, b, left);
  if (step.keep == 0.F)
    std::fill_n(d.data(), d.size(), 0.F);
  // Ghosts of d stay zero.
  for (unsigned int k = 1; k <= grid.n_nodes(2) && step.x_is_d; ++k)
    for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
      for (unsigned int c = 0; c < grid.n_components(); ++c)
        std::copy_n(x.row(c, j, k) + 1, grid.n_nodes(0), d.row(c, j, k) + 1);
  first_step(step.step, left, left);
  kernels().combine(d.size(), 1.F, left.data(), step.keep, d.data());
  kernels().combine(x.size(), 1.F, d.data(), 1.F, x.data());
}

void Level::clear_held(float *field) const
{
  for (const std::size_t place : held_places)
    field[place] = 0.F;
}

SweepArguments<float> Level::arguments(VoxelField<float> &x)
{
  SweepArguments<float> a = sweep_arguments(grid, work);
  a.x                     = x.data();
  a.stiffness             = stiffness.numbers.data();
  a.phase                 = phase != nullptr ? phase->bytes() : nullptr;
  a.material              = phase != nullptr ? phase->words() : nullptr;
  a.table                 = table.data();
  a.inverse               = inverse.data();
  a.n_diagonals           = n_diagonals();
  return a;
}

void Level::take_phases(const CellIndices &phases,
                        const Source kind_of_phases,
                        LineVector<float> &&the_table,
                        LineVector<float> &&of_product)
{
  phase             = &phases;
  source            = kind_of_phases;
  table             = std::move(the_table);
  product_table     = std::move(of_product);
  stiffness.numbers = LineVector<float>();
}

/** x = factor D^-1 b */
void Level::first_step(const float factor,
                       const VoxelField<float> &b,
                       VoxelField<float> &x)
{
  kernels().first_step(grid.n_node_rows(), grid.stride(), grid.n_components(),
                       n_diagonals(), factor, inverse.data(), b.data(), x.data());
}

double Level::product(VoxelField<float> &x, VoxelField<float> &out)
{
  SweepArguments<float> a = arguments(x);
  a.out                   = out.data();
  if (phase != nullptr)
    a.table = product_table.data();
  double energy = sweep_of<float>(kernels().product, source, cells)(a);
  for (const Spring &spring : all_springs)
    {
      const float force = spring.stiffness * x.data()[spring.column];
      out.data()[spring.row] += force;
      energy += 1. * x.data()[spring.row] * force;
    }
  return sum_over_ranks(grid, energy);
}

void Level::residual(VoxelField<float> &x,
                     const VoxelField<float> &b,
                     VoxelField<float> &out)
{
  SweepArguments<float> a = arguments(x);
  a.b                     = b.data();
  a.out                   = out.data();
  sweep_of<float>(kernels().residual, source, cells)(a);
  add_forces_of_springs(x, out);
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
      // If the solution began with zero, the first increment is the solution itself.
      a.x_is_d  = step == 1 && from_zero;
      a.is_last = step + 1 == smoothing.degree;
      if (step == 0 && from_zero)
        {
          first_step(a.step, b, x);
          x.set_ghosts();
        }
      else if (all_springs.empty())
        {
          sweep_of<float>(kernels().chebyshev, source, cells)(a);
          x.set_ghost_rows();
        }
      else
        {
          step_on_springs(a, x, b, d);
          x.set_ghosts();
        }
    }
}

std::vector<BrickMatrix> cell_matrices(const VoxelGrid &grid,
                                       const unsigned int n_coefficients)
{
  if (!grid.flat)
    return brick_matrices(grid.spacing, n_coefficients);
  // A quarter, as the coefficients are four times the bricks'.
  const bool apart = n_coefficients == n_plane_apart;
  const std::vector<BrickMatrix> all =
    brick_matrices(grid.spacing, apart ? n_general_apart : n_general);
  const auto entries = stiffness_entries<3>();
  std::vector<BrickMatrix> result;
  for (std::size_t first = 0; first < all.size(); first += entries.size())
    for (const StiffnessEntry &entry : stiffness_entries<2>())
      for (std::size_t m = 0; m < entries.size(); ++m)
        if (entries[m].row == grid.load_case(entry.row) &&
            entries[m].column == grid.load_case(entry.column))
          result.emplace_back(all[first + m] / 4.);
  return result;
}

/** The diagonal is the sum of the diagonals of the cells around a node: eight cells, or
 * on a flat grid, where both ends of y are one node, four pairs. */
void Level::set_inverse_diagonal()
{
  const unsigned int n                    = stiffness.n_coefficients;
  const std::vector<BrickMatrix> matrices = cell_matrices(grid, n);
  const unsigned int nx = grid.n_nodes(0), ny = grid.n_nodes(1), nz = grid.n_nodes(2);
  inverse.resize(grid.n_node_rows() * n_diagonals() * grid.stride());
  for (unsigned int k = 1; k <= nz; ++k)
    for (unsigned int j = 1; j <= ny; ++j)
      for (unsigned int c = 0; c < n_diagonals(); ++c)
        {
          float *out =
            &inverse[(grid.node_row(j, k) * n_diagonals() + c) * grid.stride()];
          for (unsigned int corner = 0; corner < 8; ++corner)
            for (unsigned int m = 0; m < n; ++m)
              {
                // The node is this corner of the cell before it, or of the cell that
                // begins at it.
                const unsigned int back = corner & 1U;
                const float *row =
                  stiffness.row(grid, m, j - (corner >> 1 & 1U), k - (corner >> 2));
                const unsigned int at = 3 * corner + grid.axis_of(c);
                double weight         = matrices[m](at, at);
                if (grid.flat)
                  weight += matrices[m](at, 3 * (corner ^ 2U) + grid.axis_of(c));
                for (unsigned int i = 1; i <= nx; ++i)
                  out[i] += static_cast<float>(weight) * row[i - back];
              }
          for (unsigned int i = 1; i <= nx; ++i)
            out[i] = 1.F / out[i];
        }
}

void Level::estimate_largest_eigenvalue()
{
  VoxelField<float> x(grid), q(grid);
  for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
    {
      // Start vector independent of the number of ranks.
      std::uint32_t state = 2654435761U * (grid.below() + k);
      for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
        for (unsigned int c = 0; c < grid.n_components(); ++c)
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
      first_step(static_cast<float>(1. / norm), q, x);
      norm    = norm_of_x();
      largest = safety * norm;
    }
}
} // namespace mesoslip::voxel
