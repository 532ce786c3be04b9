#include "homogenization/voxel_volume.h"

#include "base/exchange.h"
#include "program/machine.h"
#include "statics/voxel/planes.h"

#include <Eigen/LU>

namespace mesoslip
{
namespace
{
voxel::Sides sides_of(const BoundaryCondition condition)
{
  switch (condition)
    {
    case BoundaryCondition::KUBC:
      return voxel::Sides::held;
    case BoundaryCondition::SUBC:
      return voxel::Sides::free;
    case BoundaryCondition::MUBC:
      return voxel::Sides::mixed;
    default:
      return voxel::Sides::periodic;
    }
}

voxel::HeldComponents held_components(const BoundaryCondition condition,
                                      const unsigned int k)
{
  voxel::HeldComponents held;
  for (unsigned int across = 0; across < 3; ++across)
    for (unsigned int c = 0; c < 3; ++c)
      held[across][c] = is_prescribed<3>(condition, k, across, c);
  return held;
}

/** Calls action(phase, strain) with the strains of the load cases, one a column, of each
 *  cell of plane @p k of this rank, x fastest. */
template <typename Action>
void for_each_voxel(const voxel::Solver &solver,
                    const unsigned int k,
                    const Action &action)
{
  const voxel::VoxelGrid &grid = solver.grid();
  voxel::Solver::RowOfCells row;
  VoigtMatrix<3> strain;
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    {
      solver.evaluate(j, k, row);
      for (unsigned int i = 0; i < grid.cells[0]; ++i)
        {
          for (unsigned int load = 0; load < 6; ++load)
            for (unsigned int m = 0; m < 6; ++m)
              strain(m, load) = row.strain[load][m][i];
          action(row.phase[i], strain);
        }
    }
}
} // namespace

VoxelVolume::VoxelVolume(const CellPlanes &the_cells,
                         const std::vector<ElasticPhase<3>> &the_phases,
                         const bool is_flat)
  : cells(the_cells)
  , phases(the_phases)
  , flat(is_flat)
{
}

VolumeSums<3> VoxelVolume::solve(const BoundaryCondition wanted,
                                 const double tolerance,
                                 const std::function<void()> &case_done)
{
  condition = wanted;
  solver.reset();
  std::vector<VoigtMatrix<3>> stiffness;
  for (const ElasticPhase<3> &phase : phases)
    stiffness.push_back(phase.stiffness);
  solver = std::make_unique<voxel::Solver>(cells, stiffness, sides_of(condition), flat);
  std::array<SolverReport, 6> reports;
  for (unsigned int k = 0; k < 6; k += flat ? 2 : 1)
    try
      {
        if (condition == BoundaryCondition::MUBC)
          solver->hold(held_components(condition, k));
        reports[k] = solver->solve(k, tolerance);
        if (case_done)
          case_done();
      }
    catch (const NotConverged &error)
      {
        throw NotConverged(to_string(condition) + " " +
                             (flat ? voigt_names<2>[k / 2] : voigt_names<3>[k]) + ": " +
                             error.what(),
                           error.reason, error.reached);
      }
  VolumeSums<3> sums = integrate();
  sums.reports       = reports;
  return sums;
}

VolumeSums<3> VoxelVolume::integrate()
{
  VolumeSums<3> sums;
  sums.condition      = condition;
  VoigtMatrix<3> mean = VoigtMatrix<3>::Zero();
  for (const auto &strains : solver->phase_strains())
    {
      sums.phases.emplace_back();
      sums.phases.back().strain = strains.sum;
      sums.phases.back().volume = strains.n_cells;
      sums.volume += strains.n_cells;
      mean += strains.sum;
    }
  mean /= sums.volume;
  // Of stresses the solver gives the complementary energy, twice the work of the tractions
  // less the elastic energy.
  sums.energy = solver->effective_stiffness();
  if (condition == BoundaryCondition::SUBC)
    sums.energy = mean + mean.transpose() - VoigtMatrix<3>(sums.energy.inverse());
  return sums;
}

std::array<unsigned int, 2> VoxelVolume::planes() const
{
  const voxel::VoxelGrid &grid = solver->grid();
  if (!grid.is_divided() && mpi::this_mpi_process(cells.communicator) > 0)
    return {{0, 0}};
  return {{grid.below() + grid.first_cell_plane() - grid.first(), grid.n_cell_planes()}};
}

void VoxelVolume::for_each_cell(
  const unsigned int k,
  const std::function<void(const unsigned int, const VoigtMatrix<3> &)> &action) const
{
  for_each_voxel(*solver, k, action);
}

std::vector<double> VoxelVolume::concentration(const unsigned int k) const
{
  const voxel::VoxelGrid &grid = solver->grid();
  std::vector<double> tensors;
  tensors.reserve(std::size_t{36} * grid.cells[1] * grid.cells[0]);
  for_each_voxel(*solver, k, [&](const unsigned int phase, const VoigtMatrix<3> &strain) {
    const VoigtMatrix<3> tensor = condition == BoundaryCondition::SUBC
                                    ? VoigtMatrix<3>(phases[phase].stiffness * strain)
                                    : strain;
    tensors.insert(tensors.end(), tensor.data(), tensor.data() + 36);
  });
  return tensors;
}

double copies_on_this_machine(const unsigned int n_cells)
{
  // KUBC have the fewest planes of nodes that are unknowns.
  const auto n_ranks = mpi::n_mpi_processes(MPI_COMM_WORLD);
  return n_ranks == 1 || voxel::is_divided_among(n_cells - 1, n_ranks)
           ? share_of_this_machine()
           : ranks_of_this_machine();
}
} // namespace mesoslip
