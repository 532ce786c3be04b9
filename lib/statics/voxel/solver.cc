#include "statics/voxel/solver.h"

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace mesoslip::voxel
{
namespace
{
/** Drop of the residual after which it is recomputed, since it is in single precision.
 * The cell forces cancel to a much smaller sum if a displacement grows over the whole
 * body (free sides), or over the many cells along an axis of a flat body. */
double trusted_drop(const VoxelGrid &grid)
{
  return grid.flat || grid.sides == Sides::free ? 1e-2 : 1e-4;
}

/** Forces of a homogeneous volume cancel to round-off; below this share of the cells'
 * forces they are zero. */
constexpr double cancelled = 1e-12;

VoxelGrid kind_of(const Sides sides, const bool flat)
{
  VoxelGrid grid;
  grid.sides = sides;
  grid.flat  = flat;
  return grid;
}
} // namespace

Solver::Solver(const CellPlanes &cells,
               const std::vector<ElasticPhase<3>> &the_phases,
               const Sides sides,
               const bool flat)
  : K(cells, the_phases, kind_of(sides, flat))
  , iteration(K)
  , strains(the_phases.size(), UnitStrains<3>::Zero())
{
  bool has_unknowns = true;
  for (unsigned int d = 0; d < 3; ++d)
    has_unknowns = has_unknowns && K.grid.n_all_nodes(d) > 0;
  if (has_unknowns && sides != Sides::mixed)
    multigrid = K.make_multigrid({});
}

void Solver::hold(const HeldOnSides &held)
{
  if (multigrid && held == held_on_sides)
    return;
  held_on_sides = held;
  HeldComponents components(K.grid);
  for (unsigned int k = 1; k <= K.grid.n_nodes(2); ++k)
    for (unsigned int j = 1; j <= K.grid.n_nodes(1); ++j)
      for (unsigned int c = 0; c < K.grid.n_components(); ++c)
        for (unsigned int i = 1; i <= K.grid.n_nodes(0); ++i)
          {
            const std::array<unsigned int, 3> node = {{i, j, k}};
            for (unsigned int d = 0; d < 3; ++d)
              if (held[d][K.grid.axis_of(c)] && K.grid.is_on_side(d, node[d]))
                components.row(c, j, k)[i] = 1.F;
          }
  components.set_ghosts();
  multigrid.reset(); // avoids two in memory
  multigrid = K.make_multigrid(std::move(components));
}

/** Norm of the cells' loads before they cancel; see load_of(). */
double Solver::gross_load(const unsigned int k) const
{
  const VoxelGrid &grid = K.grid;
  const double volume   = grid.spacing[0] * grid.spacing[1] * grid.spacing[2];
  double sum            = 0.;
  for (std::size_t phase = 0; phase < K.of_phases.size(); ++phase)
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        {
          const unsigned int m = voigt_index<3>(c, d);
          const double stress =
            k == heat                   ? K.of_phases[phase].thermal_stress[m] / K.modulus
            : grid.sides == Sides::free ? (m == k ? 1. : 0.)
                                        : K.of_phases[phase].stiffness(m, k) / K.modulus;
          // On each of eight nodes, or on each of four nodes twice as much.
          const double force = stress * volume / (4. * grid.spacing[d]);
          sum += K.n_cells[phase] * (grid.flat ? 16. : 8.) * force * force;
        }
  return std::sqrt(sum);
}

/** Strain and stress of all cells in load case @p k. */
CellLoad Solver::load_of(const unsigned int k) const
{
  const auto &edge    = K.grid.spacing;
  const double volume = edge[0] * edge[1] * edge[2];
  CellLoad load;
  if (k == heat)
    return load;
  if (K.grid.sides == Sides::free)
    load.stress[k] = K.grid.flat ? volume / 2. : volume / 4.;
  else
    load.strain[k] = K.grid.flat ? 2. : 4.;
  return load;
}

/** Adds the nodal forces of thermal stresses in the cells around the nodes. */
void Solver::add_forces_of_heat(VoxelField<double> &force) const
{
  const VoxelGrid &grid = K.grid;
  const double volume   = grid.spacing[0] * grid.spacing[1] * grid.spacing[2];
  // On a flat grid the nodes at both ends of y are one.
  const double share = volume / ((grid.flat ? 2. : 4.) * K.modulus);
  for_each_row(
    grid, [&](const unsigned int c, const unsigned int j, const unsigned int k) {
      double *const row = force.row(c, j, k);
      for (unsigned int z = 0; z < 2; ++z)
        for (unsigned int y = 0; y < (grid.flat ? 1U : 2U); ++y)
          for (unsigned int i = 1; i <= grid.n_nodes(0); ++i)
            for (unsigned int x = 0; x < 2; ++x)
              {
                // The node is at the upper end of the cell before it along an axis.
                const std::array<unsigned int, 3> before = {{1 - x, 1 - y, 1 - z}};
                const std::size_t phase =
                  K.phases[K.grid.cell_row(j - before[1], k - before[2]) * grid.stride() +
                           i - before[0]];
                if (phase >= K.of_phases.size())
                  continue; // beyond the box
                const VoigtVector<3> &stress = K.of_phases[phase].thermal_stress;
                for (unsigned int d = 0; d < 3; ++d)
                  if (!(grid.flat && d == 1))
                    row[i] += (before[d] == 1 ? share : -share) / grid.spacing[d] *
                              stress[voigt_index<3>(grid.axis_of(c), d)];
              }
    });
}

/** outer() for one kelvin, where the forces differ from cell to cell. */
double Solver::outer_of_heat(VoxelField<double> &v, VoxelField<float> &out)
{
  VoxelField<double> exact(K.grid);
  K.forces(CellLoad(), v, out, exact.data());
  add_forces_of_heat(exact);
  std::copy_n(exact.data(), exact.size(), out.data());
  if (K.grid.sides == Sides::mixed)
    multigrid->finest().clear_held(out.data());
  return sum_over_ranks(K.grid, kernels().dot(out.size(), out.data(), out.data()));
}

/** Residual of load case @p k, and the square of its norm. */
double Solver::outer(const unsigned int k,
                     VoxelField<double> &v,
                     VoxelField<float> &out,
                     double *exact)
{
  if (k == heat)
    return outer_of_heat(v, out);
  const double square = K.forces(load_of(k), v, out, exact);
  if (K.grid.sides != Sides::mixed)
    return square;
  multigrid->finest().clear_held(out.data());
  return sum_over_ranks(K.grid, kernels().dot(out.size(), out.data(), out.data()));
}

void Solver::residual(const unsigned int k,
                      VoxelField<double> &v,
                      VoxelField<double> &out)
{
  AssertThrow(k != heat, dealii::ExcMessage("Not of the case of heat."));
  v.set_ghosts();
  outer(k, v, multigrid->finest_buffer(), out.data());
  // Converts from the units of stress and length.
  const double unit =
    (K.grid.sides == Sides::free ? 1. : K.modulus) * K.length * K.length;
  for (std::size_t i = 0; i < out.size(); ++i)
    out.data()[i] *= unit;
}

SolverReport
Solver::solve(const unsigned int k, const double tolerance, const unsigned int limit)
{
  AssertThrow(
    K.grid.sides != Sides::mixed || multigrid,
    dealii::ExcMessage("hold() has to be called before mixed sides are solved."));
  if (k != heat)
    n_solved = k == K.grid.load_case(n_solved) ? n_solved + 1 : 0;
  if (!multigrid)
    return {};
  if (u.size() == 0)
    u = VoxelField<double>(K.grid);
  else
    std::fill_n(u.data(), u.size(), 0.);
  ConjugateGradients::Problem problem;
  problem.residual = [&](VoxelField<double> &v, VoxelField<float> &out) {
    return outer(k, v, out);
  };
  problem.tolerance         = tolerance;
  problem.negligible        = cancelled * gross_load(k);
  problem.limit             = limit;
  problem.trusted_drop      = trusted_drop(K.grid);
  const SolverReport report = iteration.solve(u, *multigrid, problem);
  if (K.grid.sides == Sides::mixed && k != heat)
    K.forces(load_of(k), u, iteration.r); // cases have different constraints
  keep(k);
  return report;
}

std::array<SolverReport, 6>
Solver::solve_all(const double tolerance,
                  const std::function<void(unsigned int)> &progress)
{
  std::array<SolverReport, 6> reports;
  for (unsigned int n = 0; n < K.grid.n_load_cases(); ++n)
    {
      const unsigned int k = K.grid.load_case(n);
      reports[k]           = solve(k, tolerance);
      if (progress)
        progress(n + 1);
    }
  return reports;
}
} // namespace mesoslip::voxel
