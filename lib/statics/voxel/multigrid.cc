#include "statics/voxel/multigrid.h"

#include "base/flush_denormals.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <utility>

namespace mesoslip::voxel
{
namespace
{
/** Motions with an energy below this share of the largest are rigid motions. */
constexpr double rigid_energy = 1e-11;
/** A grid with fewer planes on a rank is replicated. */
constexpr unsigned int fewest_planes = 4;

/** Number of the unknown of a node (field numbers) on the coarsest grid; none:
 * negative. */
long unknown(const VoxelGrid &grid,
             std::array<unsigned int, 3> node,
             const unsigned int axis)
{
  if (grid.flat && axis == 1)
    return -1;
  const unsigned int c = grid.flat ? axis / 2 : axis;
  long number          = 0;
  for (unsigned int d = 3; d-- > 0;)
    {
      const unsigned int n = grid.n_nodes(d);
      if (grid.flat && d == 1)
        node[d] = 1;
      else if (grid.is_periodic(d))
        node[d] = (node[d] + n - 1) % n + 1;
      if (node[d] < 1 || node[d] > n)
        return -1;
      number = number * n + node[d] - 1;
    }
  return grid.n_components() * number + c;
}

/** Gathers the parts of all ranks on every rank, with ghosts. */
HeldComponents of_all_ranks(const HeldComponents &part, const VoxelGrid &whole)
{
  HeldComponents held(whole);
  gather_planes(part.grid(), part.data(), held.data(), part.plane_size());
  held.set_ghosts();
  return held;
}
} // namespace

Multigrid::Multigrid(const VoxelGrid &grid,
                     CellStiffness &&stiffness,
                     const Options &options,
                     HeldComponents held)
{
  const FlushDenormals flush;
  levels.emplace_back(grid, std::move(stiffness), held);
  smoothings.push_back(options.finest);
  d.emplace_back(grid);
  x.emplace_back();
  b.emplace_back();
  for (VoxelGrid next = coarser(grid); next.cells != levels.back().grid.cells;
       next           = coarser(levels.back().grid))
    {
                Level &fine = levels.back();
                transfers.emplace_back(fine.grid, next);
                const Smoothing &last = smoothings.back();
                const unsigned int degree =
                  std::max(last.degree, std::min(options.greatest, last.degree * options.growth));
                const double growth = static_cast<double>(degree) / last.degree;
                smoothings.push_back({degree, last.range / (growth * growth)});
                add_level(next, coarsened(fine.grid, fine.stiffness, next), held);
    }
  assemble_bottom();
  invert_bottom();
}

void Multigrid::hold(HeldComponents held, Springs springs)
{
  for (std::size_t l = 0; l < levels.size(); ++l)
    {
      const VoxelGrid &grid = levels[l].grid;
      const bool gathers    = l > 0 && l == first_whole;
      const VoxelGrid &part = gathers ? part_b.grid() : grid;
      if (l > 0 && held.size() > 0)
        held =
          gathers ? of_all_ranks(coarsened(held, part), grid) : coarsened(held, part);
      for (VoxelField<float> *field : {&springs.direct, &springs.mixed})
        if (l > 0 && field->size() > 0)
          {
            VoxelField<float> below(part);
            transfers[l - 1].restrict_to(*field, below);
            *field = gathers ? of_all_ranks(below, grid) : std::move(below);
          }
      levels[l].hold(held, springs);
    }
  invert_bottom();
}

/** Adds a level; replaces the constraints @p held of the finer grid by those of this
 * grid. */
void Multigrid::add_level(VoxelGrid grid, CellStiffness &&stiffness, HeldComponents &held)
{
  if (held.size() > 0)
    held = coarsened(held, grid);
  if (grid.is_divided() && !has_planes(grid, fewest_planes))
    {
      first_whole = levels.size();
      part_x = part_b      = VoxelField<float>(grid);
      CellStiffness whole  = {stiffness.n_coefficients, {}};
      const VoxelGrid part = grid;
      grid.planes.clear();
      grid.rank         = 0;
      grid.communicator = MPI_COMM_SELF;
      whole.numbers.resize(grid.n_cell_rows() * whole.n_coefficients * grid.stride());
      gather_planes(part, stiffness.numbers.data(), whole.numbers.data(),
                    grid.cell_rows_in_plane() * whole.n_coefficients * grid.stride());
      stiffness = std::move(whole);
      if (held.size() > 0)
        held = of_all_ranks(held, grid);
    }
  levels.emplace_back(grid, std::move(stiffness), held);
  x.emplace_back(grid);
  b.emplace_back(grid);
  d.emplace_back(grid);
}

void Multigrid::assemble_bottom()
{
  Level &level         = levels.back();
  const VoxelGrid grid = level.grid;
  const auto n = static_cast<Eigen::Index>(grid.n_components()) * grid.n_nodes(0) *
                 grid.n_nodes(1) * grid.n_nodes(2);
  Eigen::MatrixXd &K = bottom;
  K                  = Eigen::MatrixXd::Zero(n, n);
  const std::vector<BrickMatrix> matrices =
    cell_matrices(grid, level.stiffness.n_coefficients);
  for (unsigned int cell = 0; cell < grid.cells[0] * grid.cells[1] * grid.cells[2];
       ++cell)
    {
      const std::array<unsigned int, 3> first = {
        {cell % grid.cells[0] + grid.first(),
         cell / grid.cells[0] % grid.cells[1] + grid.first(),
         cell / grid.cells[0] / grid.cells[1] + grid.first()}};
      BrickMatrix matrix = BrickMatrix::Zero();
      for (unsigned int m = 0; m < matrices.size(); ++m)
        matrix += static_cast<double>(
                    level.stiffness.row(grid, m, first[1], first[2])[first[0]]) *
                  matrices[m];
      std::array<long, 24> index;
      for (unsigned int k = 0; k < 24; ++k)
        {
          const unsigned int corner = k / 3;
          index[k]                  = unknown(grid,
                                              {{first[0] + (corner & 1U), first[1] + (corner >> 1 & 1U),
                                                first[2] + (corner >> 2)}},
                                              k % 3);
        }
      for (unsigned int r = 0; r < 24; ++r)
        for (unsigned int c = 0; c < 24; ++c)
          if (index[r] >= 0 && index[c] >= 0)
            K(index[r], index[c]) += matrix(r, c);
    }
}

/** Pseudo-inverse with springs; zero at constrained components. */
void Multigrid::invert_bottom()
{
  const Level &level    = levels.back();
  const VoxelGrid &grid = level.grid;
  const Eigen::Index n  = bottom.rows();
  Eigen::MatrixXd K     = bottom;
  const auto number     = [&](const std::size_t place) {
    const unsigned int n_components = grid.n_components();
    const std::size_t row = place / grid.stride(), of_node = row / n_components;
    const std::size_t in_plane = grid.node_rows_in_plane();
    return unknown(grid,
                       {{static_cast<unsigned int>(place % grid.stride()),
                     static_cast<unsigned int>(of_node % in_plane),
                     static_cast<unsigned int>(of_node / in_plane)}},
                       grid.axis_of(row % n_components));
  };
  for (const Level::Spring &spring : level.springs())
    if (number(spring.row) >= 0 && number(spring.column) >= 0)
      K(number(spring.row), number(spring.column)) += spring.stiffness;
  for (const std::size_t place : level.held())
    {
      K.row(number(place)).setZero();
      K.col(number(place)).setZero();
    }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(K);
  const Eigen::VectorXd &energies = modes.eigenvalues();
  Eigen::VectorXd inverse         = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i)
    if (energies[i] > rigid_energy * energies[n - 1])
      inverse[i] = 1. / energies[i];
  bottom_inverse =
    modes.eigenvectors() * inverse.asDiagonal() * modes.eigenvectors().transpose();
}

void Multigrid::solve_bottom(VoxelField<float> &solution,
                             const VoxelField<float> &force) const
{
  const auto &n = solution.n_nodes();
  Eigen::VectorXd in(bottom_inverse.rows());
  const auto for_each = [&](const auto &function) {
    Eigen::Index index = 0;
    for (unsigned int k = 1; k <= n[2]; ++k)
      for (unsigned int j = 1; j <= n[1]; ++j)
        for (unsigned int i = 1; i <= n[0]; ++i)
          for (unsigned int c = 0; c < solution.grid().n_components(); ++c, ++index)
            function(index, c, i, j, k);
  };
  for_each([&](Eigen::Index index, unsigned int c, unsigned int i, unsigned int j,
               unsigned int k) { in[index] = force.row(c, j, k)[i]; });
  const Eigen::VectorXd out = bottom_inverse * in;
  for_each(
    [&](Eigen::Index index, unsigned int c, unsigned int i, unsigned int j,
        unsigned int k) { solution.row(c, j, k)[i] = static_cast<float>(out[index]); });
  solution.set_ghosts();
}

void Multigrid::vmult(VoxelField<float> &solution, const VoxelField<float> &force)
{
  const FlushDenormals flush;
  visit(0, solution, force);
}

void Multigrid::visit(const std::size_t l,
                      VoxelField<float> &solution,
                      const VoxelField<float> &force)
{
  if (l + 1 == levels.size())
    return solve_bottom(solution, force);
  Level &level = levels[l];
  level.smooth(smoothings[l], true, solution, force, d[l]);
  level.residual(solution, force, d[l]);
  level.clear_held(d[l].data());
  const bool gathers               = l + 1 == first_whole;
  const VoxelField<float> &x_below = gathers ? part_x : x[l + 1];
  VoxelField<float> &b_below       = gathers ? part_b : b[l + 1];
  transfers[l].restrict_to(d[l], b_below);
  if (gathers)
    gather_planes(part_b.grid(), part_b.data(), b[l + 1].data(), part_b.plane_size());
  visit(l + 1, x[l + 1], b[l + 1]);
  if (gathers)
    std::copy_n(x[l + 1].row(0, 0, part_x.grid().below()),
                part_x.plane_size() * (part_x.n_nodes()[2] + 2), part_x.data());
  transfers[l].add_from(x_below, solution);
  level.clear_held(solution.data());
  solution.set_ghosts();
  level.smooth(smoothings[l], false, solution, force, d[l]);
}
} // namespace mesoslip::voxel
