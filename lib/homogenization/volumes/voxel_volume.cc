#include "homogenization/volumes/voxel_volume.h"

#include "base/exchange.h"
#include "body/strain_modes.h"
#include "material/stiffness.h"
#include "program/machine.h"
#include "statics/voxel/planes.h"

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

voxel::HeldOnSides held_components(const BoundaryCondition condition,
                                   const unsigned int k)
{
  voxel::HeldOnSides held;
  for (unsigned int across = 0; across < 3; ++across)
    for (unsigned int c = 0; c < 3; ++c)
      held[across][c] = is_prescribed<3>(condition, k, across, c);
  return held;
}

/** Voigt index in 3D of component @p m (xx, yy, xy in 2D); y of a plane is z in the
 * solver. */
template <int dim>
constexpr unsigned int place(const unsigned int m)
{
  return dim == 2 ? 2 * m : m;
}

/** Index of a load case (Voigt and, last, heat) in the solver. */
template <int dim>
constexpr unsigned int place_of_case(const unsigned int k)
{
  if (k < n_voigt<dim>)
    return place<dim>(k);
  return voxel::Solver::heat;
}

/** The part of strains that is in the plane. */
template <int dim>
UnitStrains<dim> in_plane(const UnitStrains<3> &space)
{
  UnitStrains<dim> result;
  for (unsigned int k = 0; k <= n_voigt<dim>; ++k)
    for (unsigned int i = 0; i < n_voigt<dim>; ++i)
      result(i, k) = space(place<dim>(i), place_of_case<dim>(k));
  return result;
}

/** The same matrix in 3D; out-of-plane entries are zero. */
template <int dim>
VoigtMatrix<3> in_space(const VoigtMatrix<dim> &matrix)
{
  VoigtMatrix<3> result = VoigtMatrix<3>::Zero();
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    for (unsigned int j = 0; j < n_voigt<dim>; ++j)
      result(place<dim>(i), place<dim>(j)) = matrix(i, j);
  return result;
}

/** The part of a matrix that is in the plane. */
template <int dim>
VoigtMatrix<dim> in_plane(const VoigtMatrix<3> &space)
{
  VoigtMatrix<dim> result;
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    for (unsigned int j = 0; j < n_voigt<dim>; ++j)
      result(i, j) = space(place<dim>(i), place<dim>(j));
  return result;
}
} // namespace

// The thickness is arbitrary.
UniformGrid<3> in_space(const UniformGrid<2> &grid)
{
  return {{{grid.cells[0], 1, grid.cells[1]}},
          {{grid.spacing[0], grid.spacing[0], grid.spacing[1]}},
          {{grid.origin[0], 0., grid.origin[1]}}};
}

template <int dim>
VoxelVolume<dim>::VoxelVolume(const UniformGrid<dim> &the_grid,
                              const CellPlanes &the_cells,
                              const std::vector<ElasticPhase<dim>> &the_phases)
  : grid(the_grid)
  , cells(the_cells)
{
  for (const ElasticPhase<dim> &phase : the_phases)
    {
      phases.push_back(
        {in_space<dim>(phase.stiffness), phase.density, phase.mean_dilatation});
      for (unsigned int m = 0; m < n_voigt<dim>; ++m)
        phases.back().thermal_stress[place<dim>(m)] = phase.thermal_stress[m];
    }
}

template <int dim>
VolumeSums<dim> VoxelVolume<dim>::solve(const BoundaryCondition wanted,
                                        const double tolerance,
                                        const std::function<void()> &case_done)
{
  condition = wanted;
  solver.reset();
  solver = std::make_unique<voxel::Solver>(cells, phases, sides_of(condition), dim == 2);
  const std::vector<unsigned int> order = order_of_cases<dim>(has_expansion(phases));
  std::vector<SolverReport> reports(order.size());
  for (const unsigned int k : order)
    try
      {
        if (condition == BoundaryCondition::MUBC)
          solver->hold(held_components(condition, place_of_case<dim>(k)));
        reports[k] = solver->solve(place_of_case<dim>(k), tolerance);
        if (case_done)
          case_done();
      }
    catch (const NotConverged &error)
      {
        throw NotConverged(to_string(condition) + " " + name_of_case<dim>(k) + ": " +
                             error.what(),
                           error.reason, error.reached);
      }
  VolumeSums<dim> sums = integrate();
  sums.reports         = reports;
  return sums;
}

template <int dim>
VolumeSums<dim> VoxelVolume<dim>::integrate() const
{
  VolumeSums<dim> sums;
  sums.condition      = condition;
  VoigtMatrix<3> mean = VoigtMatrix<3>::Zero();
  for (const auto &strains : solver->phase_strains())
    {
      sums.phases.push_back({in_plane<dim>(strains.sum), strains.n_cells});
      sums.volume += strains.n_cells;
      mean += strains.sum.leftCols<6>();
    }
  mean /= sums.volume;
  // Under prescribed stresses the solver gives the complementary energy: twice the work
  // of the tractions minus the elastic energy.
  VoigtMatrix<3> energy = solver->effective_stiffness();
  if (condition == BoundaryCondition::SUBC)
    energy = mean + mean.transpose() - inverse<3>(energy);
  sums.energy = in_plane<dim>(energy);
  return sums;
}

template <int dim>
PlaneRange VoxelVolume<dim>::planes() const
{
  const voxel::VoxelGrid &part = solver->grid();
  if (!part.is_divided() && mpi::this_mpi_process(cells.communicator) > 0)
    return {0, 0};
  return {part.below() + part.first_cell_plane() - part.first(), part.n_cell_planes()};
}

template <int dim>
void VoxelVolume<dim>::for_each(const Action &action) const
{
  const PlaneRange own      = planes();
  const UniformGrid<3> &box = cells.grid;
  const auto centre         = [this](const unsigned int d, const unsigned int index) {
    return grid.origin[d] + (static_cast<double>(index) + 0.5) * grid.spacing[d];
  };
  voxel::Solver::RowOfCells row;
  LocalCell<dim> cell;
  cell.volume = 1.;
  for (unsigned int k = 0; k < own.count; ++k)
    for (unsigned int j = 0; j < box.cells[1]; ++j)
      {
        solver->evaluate(j, k, row);
        if (dim == 3)
          cell.centre[1] = centre(1, j);
        cell.centre[dim - 1] = centre(dim - 1, own.first + k);
        for (unsigned int i = 0; i < box.cells[0]; ++i)
          {
            cell.centre[0] = centre(0, i);
            cell.phase     = row.phase[i];
            for (unsigned int load = 0; load <= n_voigt<dim>; ++load)
              for (unsigned int m = 0; m < n_voigt<dim>; ++m)
                cell.strain(m, load) =
                  row.strain[place_of_case<dim>(load)][place<dim>(m)][i];
            action(cell);
          }
      }
}

template <int dim>
void VoxelVolume<dim>::for_each_sample(const Sample &visit) const
{
  const voxel::VoxelGrid &part = solver->grid();
  std::array<double, dim> spacing;
  for (unsigned int d = 0; d < dim; ++d)
    spacing[d] = part.spacing[place<dim>(d)];
  StrainModes<dim> modes(spacing);
  UnitStrains<dim> applied = UnitStrains<dim>::Zero();
  if (condition != BoundaryCondition::SUBC)
    applied.setIdentity(); // 0 for heat
  voxel::Solver::NodesOfRow row;
  for (unsigned int k = 0; k < planes().count; ++k)
    for (unsigned int j = 0; j < cells.grid.cells[1]; ++j)
      {
        solver->evaluate(j, k, row);
        for (unsigned int i = 0; i < cells.grid.cells[0]; ++i)
          {
            for (unsigned int corner = 0; corner < 1U << dim; ++corner)
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int load = 0; load <= n_voigt<dim>; ++load)
                  // In 2D the second bit is the z bit.
                  modes.displacement(corner, c)[load] = row.displacement(
                    place_of_case<dim>(load), c, dim == 2 ? corner & 2U : corner >> 1,
                    i + corner % 2);
            const unsigned int phase = row.phase[i];
            modes.visit(
              phases[phase].mean_dilatation, 1.,
              [&](const double volume, const UnitStrains<dim> &strain) {
                visit(phase, volume, strain);
              },
              applied);
          }
      }
}

template <int dim>
void VoxelVolume<dim>::write(const std::string &path,
                             const std::vector<CellDataset> &datasets,
                             const std::size_t n,
                             const Values &values) const
{
  const UniformGrid<3> &box = cells.grid;
  write_rows_of_cells(*this, planes(), std::size_t{box.cells[0]} * box.cells[1], path,
                      datasets, n, values);
}

template class VoxelVolume<2>;
template class VoxelVolume<3>;

double copies_on_this_machine(const unsigned int n_cells)
{
  // KUBC have the fewest planes of unknown nodes.
  const auto n_ranks = mpi::n_mpi_processes(MPI_COMM_WORLD);
  return n_ranks == 1 || voxel::is_divided_among(n_cells - 1, n_ranks)
           ? share_of_this_machine()
           : ranks_of_this_machine();
}
} // namespace mesoslip
