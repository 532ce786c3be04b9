#include "statics/voxel/planes.h"

#include <algorithm>

namespace mesoslip::voxel
{
namespace
{
constexpr int upwards = 81, downwards = 82; ///< message tags

MPI_Datatype type_of(const float *)
{
  return MPI_FLOAT;
}

MPI_Datatype type_of(const double *)
{
  return MPI_DOUBLE;
}

/** MPI type of a plane as a single item. */
class PlaneType
{
public:
  template <typename Number>
  PlaneType(const Number *numbers, const std::size_t size)
  {
    MPI_Type_contiguous(static_cast<int>(size), type_of(numbers), &type);
    MPI_Type_commit(&type);
  }
  ~PlaneType()
  {
    MPI_Type_free(&type);
  }
  PlaneType(const PlaneType &)            = delete;
  PlaneType &operator=(const PlaneType &) = delete;

  MPI_Datatype type = MPI_DATATYPE_NULL;
};

/** The rank @p step further, or MPI_PROC_NULL. */
int neighbour(const VoxelGrid &grid, const int step)
{
  const int n     = static_cast<int>(grid.planes.size()) - 1,
            other = static_cast<int>(grid.rank) + step;
  if (grid.is_periodic(2))
    return (other + n) % n;
  return other < 0 || other >= n ? MPI_PROC_NULL : other;
}

/** Sends a plane to the rank @p step further and stores the plane from the other side in
 * @p received.
 * @return whether a plane arrived */
template <typename Number>
bool shift(const VoxelGrid &grid,
           const int step,
           const Number *sent,
           Number *received,
           const std::size_t size)
{
  const int tag = step > 0 ? upwards : downwards, from = neighbour(grid, -step);
  MPI_Sendrecv(sent, static_cast<int>(size), type_of(sent), neighbour(grid, step), tag,
               received, static_cast<int>(size), type_of(received), from, tag,
               grid.communicator, MPI_STATUS_IGNORE);
  return from != MPI_PROC_NULL;
}

/** As shift(), but adds the plane that arrives to @p sum. */
void shift_and_add(const VoxelGrid &grid,
                   const int step,
                   const float *sent,
                   float *sum,
                   const std::size_t size)
{
  LineVector<float> received(size);
  if (shift(grid, step, sent, received.data(), size))
    for (std::size_t i = 0; i < size; ++i)
      sum[i] += received[i];
}
} // namespace

void divide(VoxelGrid &grid, const MPI_Comm communicator)
{
  int rank = 0, n_ranks = 0;
  MPI_Comm_rank(communicator, &rank);
  MPI_Comm_size(communicator, &n_ranks);
  const std::size_t n_planes = grid.n_all_nodes(2);
  const auto n               = static_cast<unsigned int>(n_ranks);
  if (n == 1 || !is_divided_among(n_planes, n))
    return;
  for (unsigned int r = 0; r <= n; ++r)
    grid.planes.push_back(static_cast<unsigned int>(n_planes * r / n));
  grid.communicator = communicator;
  grid.rank         = static_cast<unsigned int>(rank);
}

void divide_as(const VoxelGrid &fine, VoxelGrid &coarse)
{
  // In units of the box over the product of both numbers of cells, node i of the fine
  // grid is at (i - first) m, node i of the coarse one at (i - first) n.
  const std::size_t n = fine.cells[2], m = coarse.cells[2];
  for (unsigned int &below : coarse.planes)
    {
      const std::size_t place  = (below + std::size_t{1} - fine.first()) * m;
      const std::size_t before = (place + n - 1) / n - (fine.first() == 0 ? 1 : 0);
      below =
        static_cast<unsigned int>(std::min<std::size_t>(before, coarse.n_all_nodes(2)));
    }
}

bool has_planes(const VoxelGrid &grid, const unsigned int n)
{
  for (std::size_t r = 0; r + 1 < grid.planes.size(); ++r)
    if (grid.planes[r + 1] - grid.planes[r] < n)
      return false;
  return true;
}

template <typename Number>
void set_ghost_planes(const VoxelGrid &grid, Number *nodes, const std::size_t size)
{
  if (!grid.is_divided())
    return;
  const std::size_t n = grid.n_nodes(2);
  shift(grid, 1, nodes + n * size, nodes, size);
  shift(grid, -1, nodes + size, nodes + (n + 1) * size, size);
}

void add_ghost_planes(const VoxelGrid &grid, float *nodes, const std::size_t size)
{
  if (!grid.is_divided())
    return;
  const std::size_t n = grid.n_nodes(2);
  shift_and_add(grid, 1, nodes + (n + 1) * size, nodes + size, size);
  shift_and_add(grid, -1, nodes, nodes + n * size, size);
}

void sum_shared_cells(const VoxelGrid &grid, float *cells, const std::size_t size)
{
  if (!grid.is_divided())
    return;
  float *last = cells + grid.n_nodes(2) * size;
  shift_and_add(grid, -1, cells, last, size);
  shift(grid, 1, last, cells, size);
}

void gather_planes(const VoxelGrid &grid,
                   const float *part,
                   float *whole,
                   const std::size_t size)
{
  const PlaneType plane(part, size);
  std::vector<int> counts, places;
  for (std::size_t r = 0; r + 1 < grid.planes.size(); ++r)
    {
      const unsigned int first = r == 0 ? 0 : 1;
      counts.push_back(static_cast<int>(grid.planes[r + 1] - grid.planes[r] + 1 - first));
      places.push_back(static_cast<int>(grid.planes[r] + first));
    }
  MPI_Allgatherv(part + (grid.rank == 0 ? 0 : size), counts[grid.rank], plane.type, whole,
                 counts.data(), places.data(), plane.type, grid.communicator);
}

void sum_over_ranks(const VoxelGrid &grid, double *values, const unsigned int n)
{
  if (grid.is_divided())
    MPI_Allreduce(MPI_IN_PLACE, values, static_cast<int>(n), MPI_DOUBLE, MPI_SUM,
                  grid.communicator);
}

template void set_ghost_planes(const VoxelGrid &, float *, const std::size_t);
template void set_ghost_planes(const VoxelGrid &, double *, const std::size_t);
} // namespace mesoslip::voxel
