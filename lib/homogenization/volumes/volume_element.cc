#include "homogenization/volumes/volume_element.h"

#include "base/exchange.h"
#include "io/parallel_rows.h"

#include <memory>

namespace mesoslip
{
namespace
{
/** Extracts the numbers of @p dataset from @p values of consecutive cells, @p n numbers
 * per cell. */
std::vector<double> values_of(const CellDataset &dataset,
                              const std::vector<double> &values,
                              const std::size_t n)
{
  std::vector<double> part;
  part.reserve(values.size() / n * dataset.components);
  for (std::size_t begin = dataset.first; begin < values.size(); begin += n)
    for (std::size_t c = 0; c < dataset.components; ++c)
      part.push_back(values[begin + c]);
  return part;
}
} // namespace

template <int dim>
void write_rows_of_cells(const VolumeElement<dim> &volume,
                         const PlaneRange &rows,
                         const std::size_t cells_in_row,
                         const std::string &path,
                         const std::vector<CellDataset> &datasets,
                         const std::size_t n,
                         const typename VolumeElement<dim>::Values &values)
{
  std::vector<std::unique_ptr<ParallelRows>> files;
  for (const CellDataset &dataset : datasets)
    files.push_back(
      std::make_unique<ParallelRows>(path, dataset.name, volume.communicator()));
  const unsigned int most = mpi::max(rows.count, volume.communicator());
  std::vector<double> row;
  row.reserve(n * cells_in_row);
  const auto write = [&](const unsigned int number) {
    for (std::size_t d = 0; d < files.size(); ++d)
      files[d]->write(number, 0, values_of(datasets[d], row, n));
    row.clear();
  };
  unsigned int next = rows.first;
  volume.for_each([&](const LocalCell<dim> &cell) {
    row.resize(row.size() + n);
    values(cell, &row[row.size() - n]);
    if (row.size() == n * cells_in_row)
      write(next++);
  });
  // Collective writes: ranks with fewer rows write nothing at the end.
  for (unsigned int k = rows.count; k < most; ++k)
    write(0);
}

#define MESOSLIP_INSTANTIATE(dim)                                             \
  template void write_rows_of_cells<dim>(                                     \
    const VolumeElement<dim> &, const PlaneRange &, const std::size_t,        \
    const std::string &, const std::vector<CellDataset> &, const std::size_t, \
    const VolumeElement<dim>::Values &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
