#include "dynamics/deformation_watch.h"

#include "grid/row_partition.h"

#include <algorithm>

namespace mesoslip
{
DeformationWatch::DeformationWatch(
  const UniformGrid<2> &grid,
  const NodeRows &rows,
  NodalField<double> &u,
  const std::function<void(const Deformation &, std::uint64_t)> &found,
  const MPI_Comm communicator)
  : grid(grid)
  , rows(rows)
  , u(u)
  , found(found)
  , communicator(communicator)
{
}

void DeformationWatch::look(const std::uint64_t n)
{
  update_ghost_rows(u, rows, communicator);
  const Deformation deformation = largest_deformation(grid, rows, u, communicator);
  largest                       = std::max(largest, deformation.strain.value);
  found(deformation, n);
}
} // namespace mesoslip
