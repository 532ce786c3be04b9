#include "exchange/cell_datasets.h"

#include "base/exchange.h"
#include "io/parallel_rows.h"

#include <vector>

namespace mesoslip
{
void reserve_cells(Hdf5File &file,
                   const std::string &phases,
                   const Shape &shape,
                   const bool with_orientations)
{
  file.reserve<std::uint8_t>(phases, shape);
  file.write_unit(phases, "-");
  if (with_orientations)
    {
      file.reserve<std::uint16_t>(orientations_dataset, shape);
      file.write_unit(orientations_dataset, "-");
    }
}

void reserve_cells(const std::string &path,
                   const Shape &shape,
                   const bool with_orientations)
{
  Hdf5File file = Hdf5File::resume(path);
  reserve_cells(file, phases_dataset, shape, with_orientations);
  file.leave();
}

void write_cell_planes(const std::string &path,
                       const std::string &name,
                       const CellPlanes &cells)
{
  ParallelRows rows(path, name, cells.communicator);
  const PlaneRange planes = own_planes(cells.grid.cells[2], cells.communicator);
  const std::size_t n     = cells.grid.cells_in_layer();
  const unsigned int most = mpi::max(planes.count, cells.communicator);
  for (unsigned int k = 0; k < most; ++k)
    {
      const bool is_own = k < planes.count;
      std::vector<double> values(is_own ? n : 0);
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = cells.own[k * n + i];
      rows.write(is_own ? planes.first + k : 0, 0, values);
    }
}
} // namespace mesoslip
