#include "homogenization/loads/volume_cells.h"

#include "base/exchange.h"
#include "io/parallel_rows.h"
#include "mesh/point_blocks.h"

#include <memory>

namespace mesoslip
{
namespace
{
/** The datasets opened for writing. Collective. */
std::vector<std::unique_ptr<ParallelRows>>
open_datasets(const std::string &path,
              const std::vector<CellDataset> &datasets,
              const MPI_Comm communicator)
{
  std::vector<std::unique_ptr<ParallelRows>> rows;
  for (const CellDataset &dataset : datasets)
    rows.push_back(std::make_unique<ParallelRows>(path, dataset.name, communicator));
  return rows;
}
} // namespace

GridCells::GridCells(const ElasticBody<2> &body,
                     const LoadCaseSolutions &solutions,
                     const UniformGrid<2> &grid)
  : body(body)
  , solutions(solutions)
  , grid(grid)
{
}

void GridCells::for_each(const Action &action) const
{
  LocalCell<2> cell;
  std::array<ElasticBody<2>::Cells, 3> cells;
  std::size_t number = 0;
  for (std::size_t group = 0; group < body.n_cell_groups(); ++group)
    {
      for (unsigned int k = 0; k < 3; ++k)
        body.evaluate(solutions.displacement[k], group, cells[k]);
      for (std::size_t i = 0; i < cells[0].phase.size(); ++i, ++number)
        {
          cell.phase                             = cells[0].phase[i];
          cell.volume                            = cells[0].volume[i];
          const std::array<std::size_t, 2> place = {
            {number % grid.cells[0], number / grid.cells[0]}};
          for (unsigned int d = 0; d < 2; ++d)
            cell.centre[d] =
              grid.origin[d] + (static_cast<double>(place[d]) + 0.5) * grid.spacing[d];
          for (unsigned int k = 0; k < 3; ++k)
            cell.strain.col(k) = cells[k].strain[i];
          action(cell);
        }
    }
}

void GridCells::write(const std::string &path,
                      const std::vector<CellDataset> &datasets,
                      const std::size_t n,
                      const Values &values) const
{
  const auto rows = open_datasets(path, datasets, MPI_COMM_SELF);
  std::vector<double> row(n * grid.cells[0]);
  std::size_t i = 0, j = 0;
  for_each([&](const LocalCell<2> &cell) {
    values(cell, &row[n * i]);
    if (++i < grid.cells[0])
      return;
    for (std::size_t d = 0; d < rows.size(); ++d)
      rows[d]->write(j, 0, values_of(datasets[d], row, n));
    i = 0;
    ++j;
  });
}

template <int dim>
void MeshCells<dim>::for_each(const Action &action) const
{
  volume.for_each_cell(
    [&action](const std::uint64_t, const LocalCell<dim> &cell) { action(cell); });
}

template <int dim>
void MeshCells<dim>::write(const std::string &path,
                           const std::vector<CellDataset> &datasets,
                           const std::size_t n,
                           const Values &values) const
{
  std::vector<std::uint64_t> numbers;
  std::vector<double> own;
  volume.for_each_cell([&](const std::uint64_t number, const LocalCell<dim> &cell) {
    numbers.push_back(number);
    own.resize(own.size() + n);
    values(cell, &own[own.size() - n]);
  });
  const NumberedBlocks blocks(
    numbers, mpi::sum<std::uint64_t>(numbers.size(), communicator()), communicator());
  for (const CellDataset &dataset : datasets)
    ParallelRows(path, dataset.name, communicator())
      .write_rows(blocks.first(),
                  blocks.gather(own, n, dataset.first, dataset.components));
}

template <int dim>
void VoxelCells<dim>::for_plane(const unsigned int k, const Action &action) const
{
  LocalCell<dim> cell;
  cell.volume       = 1.;
  std::size_t place = 0;
  volume.for_each_cell(k, [&](const unsigned int phase, const VoigtMatrix<dim> &strain) {
    std::size_t rest = place++;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const std::size_t index =
          d + 1 < dim ? rest % grid.cells[d] : volume.planes()[0] + k;
        rest /= grid.cells[d];
        cell.centre[d] =
          grid.origin[d] + (static_cast<double>(index) + 0.5) * grid.spacing[d];
      }
    cell.phase  = phase;
    cell.strain = strain;
    action(cell);
  });
}

template <int dim>
void VoxelCells<dim>::for_each(const Action &action) const
{
  for (unsigned int k = 0; k < volume.planes()[1]; ++k)
    for_plane(k, action);
}

template <int dim>
void VoxelCells<dim>::write(const std::string &path,
                            const std::vector<CellDataset> &datasets,
                            const std::size_t n,
                            const Values &values) const
{
  const auto rows           = open_datasets(path, datasets, ranks);
  const auto [first, count] = volume.planes();
  const unsigned int most   = mpi::max(count, ranks);
  std::vector<double> plane;
  for (unsigned int k = 0; k < most; ++k)
    {
      plane.clear();
      if (k < count)
        for_plane(k, [&](const LocalCell<dim> &cell) {
          plane.resize(plane.size() + n);
          values(cell, &plane[plane.size() - n]);
        });
      for (std::size_t d = 0; d < rows.size(); ++d)
        rows[d]->write(k < count ? first + k : 0, 0, values_of(datasets[d], plane, n));
    }
}

template class MeshCells<2>;
template class MeshCells<3>;
template class VoxelCells<2>;
template class VoxelCells<3>;
} // namespace mesoslip
