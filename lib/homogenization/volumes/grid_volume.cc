#include "homogenization/volumes/grid_volume.h"

#include "base/exchange.h"
#include "body/strain_modes.h"

namespace mesoslip
{
namespace
{
/** Evaluates the cells of @p group under all load cases that were solved. */
void evaluate(const ElasticBody<2> &body,
              const LoadCaseSolutions &solutions,
              const std::size_t group,
              std::array<ElasticBody<2>::Cells, 4> &cells)
{
  for (unsigned int k = 0; k < 4; ++k)
    if (solutions.field(k).size() > 0)
      body.evaluate(solutions.field(k), group, cells[k]);
}

/** Strains of cell @p i in the evaluated @p cells. */
UnitStrains<2> strains(const std::array<ElasticBody<2>::Cells, 4> &cells,
                       const std::size_t i)
{
  UnitStrains<2> result = UnitStrains<2>::Zero();
  for (unsigned int k = 0; k < 4; ++k)
    if (!cells[k].strain.empty())
      result.col(k) = cells[k].strain[i];
  return result;
}

/** Node at column @p i and row @p j of a grid of @p cells in the fields of @p body: rows
 * of the grid, or one row of all points. */
NodeIndex node_at(const ElasticBody<2> &body,
                  const std::array<unsigned int, 2> &cells,
                  const unsigned int i,
                  const unsigned int j)
{
  const unsigned int n = j * (cells[0] + 1) + i;
  return {n % body.n_columns(), n / body.n_columns()};
}

/** Nodal forces (N/m) of the thermal stress of the cells for one kelvin; empty without
 * thermal expansion. */
NodalField<double> forces_of_heat(const ElasticBody<2> &body,
                                  const UniformMaterial &material)
{
  if (!has_expansion(material.phases()))
    return {};
  NodalField<double> force                 = body.zero_field();
  const std::array<unsigned int, 2> &cells = material.grid().cells;
  const std::array<double, 2> &h           = material.grid().spacing;
  for (unsigned int j = 0; j < cells[1]; ++j)
    for (unsigned int i = 0; i < cells[0]; ++i)
      for (unsigned int corner = 0; corner < 4; ++corner)
        {
          const VoigtVector<2> &stress =
            material.phases()[material.phase_of(i, j)].thermal_stress;
          const NodeIndex node = node_at(body, cells, i + corner % 2, j + corner / 2);
          const double x       = corner % 2 != 0 ? 0.5 * h[1] : -0.5 * h[1],
                       y       = corner / 2 != 0 ? 0.5 * h[0] : -0.5 * h[0];
          force(0, node) += stress[0] * x + stress[2] * y;
          force(1, node) += stress[2] * x + stress[1] * y;
        }
  return force;
}

/** Strain integrals of the phases; the unit of volume is a mean cell. */
std::vector<PhaseSums<2>> sum_over_cells(const ElasticBody<2> &body,
                                         const LoadCaseSolutions &solutions)
{
  std::vector<PhaseSums<2>> sums(body.phases().size());
  std::array<ElasticBody<2>::Cells, 4> cells;
  for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
    {
      evaluate(body, solutions, group, cells);
      std::vector<PhaseSums<2>> part(sums.size());
      for (std::size_t i = 0; i < cells[0].phase.size(); ++i)
        {
          const unsigned int phase = cells[0].phase[i];
          part[phase].strain += cells[0].volume[i] * strains(cells, i);
          part[phase].volume += cells[0].volume[i];
        }
      for (std::size_t p = 0; p < sums.size(); ++p)
        {
          sums[p].strain += part[p].strain;
          sums[p].volume += part[p].volume;
        }
    }
  return sums;
}

// u_k.K u_l / V
VoigtMatrix<2> energy_products(const ElasticBody<2> &body,
                               const LoadCaseSolutions &solutions)
{
  VoigtMatrix<2> products;
  const auto &u         = solutions.displacement;
  NodalField<double> Ku = body.zero_field();
  for (unsigned int l = 0; l < 3; ++l)
    {
      body.vmult(Ku, u[l]);
      for (unsigned int k = 0; k < 3; ++k)
        {
          double sum = 0.;
          for (unsigned int c = 0; c < 2; ++c)
            for (unsigned int j = 0; j < Ku.n_rows(); ++j)
              {
                double row = 0.;
                for (unsigned int i = 0; i < Ku.n_columns(); ++i)
                  row += u[k].row(c, j)[i] * Ku.row(c, j)[i];
                sum += row;
              }
          products(k, l) = sum;
        }
    }
  return products / body.volume();
}
} // namespace

VolumeSums<2> sum_up(const ElasticBody<2> &body, const LoadCaseSolutions &solutions)
{
  VolumeSums<2> sums;
  sums.condition = solutions.condition;
  sums.reports   = solutions.reports;
  sums.phases    = sum_over_cells(body, solutions);
  sums.volume    = body.n_cells();
  sums.energy    = energy_products(body, solutions);
  return sums;
}

GridVolume::GridVolume(const UniformGrid<2> &the_grid,
                       const UniformMaterial &the_material,
                       const StaticSolverKind solver,
                       const std::vector<BoundaryCondition> &conditions,
                       const double tolerance,
                       const MPI_Comm communicator,
                       const std::function<void()> &case_done,
                       Timer *timer)
  : grid(the_grid)
  , material(the_material)
  , is_root(mpi::this_mpi_process(communicator) == 0)
  , body(make_body(material, solver, communicator))
  , solutions(solve_load_cases(*body,
                               conditions,
                               tolerance,
                               communicator,
                               case_done,
                               timer,
                               forces_of_heat(*body, material)))
{
}

VolumeSums<2> GridVolume::solve(const BoundaryCondition condition,
                                const double /*tolerance*/,
                                const std::function<void()> & /*case_done*/)
{
  if (solutions[current].condition != condition)
    {
      solutions[current].displacement = {};
      solutions[current].of_heat      = {};
    }
  while (solutions[current].condition != condition)
    ++current;
  return is_root || body->is_distributed() ? sum_up(*body, solutions[current])
                                           : VolumeSums<2>();
}

void GridVolume::for_each(const Action &action) const
{
  LocalCell<2> cell;
  std::array<ElasticBody<2>::Cells, 4> cells;
  std::size_t number = 0;
  for (std::size_t group = 0; group < body->n_cell_groups(); ++group)
    {
      evaluate(*body, solutions[current], group, cells);
      for (std::size_t i = 0; i < cells[0].phase.size(); ++i, ++number)
        {
          cell.phase                             = cells[0].phase[i];
          cell.volume                            = cells[0].volume[i];
          const std::array<std::size_t, 2> place = {
            {number % grid.cells[0], number / grid.cells[0]}};
          for (unsigned int d = 0; d < 2; ++d)
            cell.centre[d] =
              grid.origin[d] + (static_cast<double>(place[d]) + 0.5) * grid.spacing[d];
          cell.strain = strains(cells, i);
          action(cell);
        }
    }
}

void GridVolume::for_each_sample(const Sample &visit) const
{
  const LoadCaseSolutions &solved = solutions[current];
  StrainModes<2> modes(grid.spacing);
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const unsigned int phase = material.phase_of(i, j);
        for (unsigned int corner = 0; corner < 4; ++corner)
          for (unsigned int c = 0; c < 2; ++c)
            for (unsigned int k = 0; k < 4; ++k)
              modes.displacement(corner, c)[k] =
                solved.field(k).size() > 0
                  ? solved.field(k)(
                      c, node_at(*body, grid.cells, i + corner % 2, j + corner / 2))
                  : 0.;
        modes.visit(material.phases()[phase].mean_dilatation, 1.,
                    [&](const double volume, const UnitStrains<2> &strain) {
                      visit(phase, volume, strain);
                    });
      }
}

void GridVolume::write(const std::string &path,
                       const std::vector<CellDataset> &datasets,
                       const std::size_t n,
                       const Values &values) const
{
  write_rows_of_cells(*this, {0, grid.cells[1]}, grid.cells[0], path, datasets, n,
                      values);
}
} // namespace mesoslip
