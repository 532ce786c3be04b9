#include "grid/cell_planes.h"

#include "base/exchange.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <map>
#include <string>

namespace mesoslip
{

namespace
{
/** Copies the cells of @p planes from @p cells, which begin with plane @p first. */
CellIndices copy_planes(const CellView &cells,
                        const unsigned int first,
                        const std::vector<unsigned int> &planes,
                        const std::size_t n_in_plane,
                        const std::size_t largest)
{
  CellIndices copied(planes.size() * n_in_plane, largest);
  for (std::size_t k = 0; k < planes.size(); ++k)
    for (std::size_t i = 0; i < n_in_plane; ++i)
      copied.set(k * n_in_plane + i, cells[(planes[k] - first) * n_in_plane + i]);
  return copied;
}

/** Elements of @p planes inside @p range, in their order. */
std::vector<unsigned int> planes_in(const PlaneRange &range,
                                    const std::vector<unsigned int> &planes)
{
  std::vector<unsigned int> found;
  for (const unsigned int plane : planes)
    if (range.contains(plane))
      found.push_back(plane);
  return found;
}
} // namespace

PlaneRange planes_of_rank(const unsigned int n_planes,
                          const unsigned int rank,
                          const unsigned int n_ranks)
{
  const std::size_t r = rank;
  const auto begin    = static_cast<unsigned int>(r * n_planes / n_ranks),
             end      = static_cast<unsigned int>((r + 1) * n_planes / n_ranks);
  return {begin, end - begin};
}

PlaneRange own_planes(const unsigned int n_planes, const MPI_Comm communicator)
{
  return planes_of_rank(n_planes, mpi::this_mpi_process(communicator),
                        mpi::n_mpi_processes(communicator));
}

CellPlanes::CellPlanes(const UniformGrid<3> &box,
                       const CellView &of_rank,
                       const MPI_Comm ranks)
  : grid(box)
  , own(of_rank)
  , communicator(ranks)
{
  AssertDimension(own.size(),
                  own_planes(grid.cells[2], ranks).count * grid.cells_in_layer());
}

CellPlanes
CellPlanes::of_whole(const UniformGrid<3> &box, const CellView &all, const MPI_Comm ranks)
{
  const PlaneRange range = own_planes(box.cells[2], ranks);
  const std::size_t n    = box.cells_in_layer();
  return {box, all.part(range.first * n, range.count * n), ranks};
}

CellIndices CellPlanes::bring(const std::vector<unsigned int> &wanted,
                              const std::size_t largest) const
{
  const unsigned int n_ranks = mpi::n_mpi_processes(communicator);
  const std::size_t n        = grid.cells_in_layer();
  const PlaneRange range     = own_planes(grid.cells[2], communicator);
  if (n_ranks == 1)
    return copy_planes(own, 0, wanted, n, largest);
  const auto wanted_of_rank = mpi::all_gather(wanted, communicator);
  std::map<unsigned int, std::string> to_send;
  for (unsigned int r = 0; r < n_ranks; ++r)
    if (const auto planes = planes_in(range, wanted_of_rank[r]); !planes.empty())
      to_send[r] = copy_planes(own, range.first, planes, n, largest).text();
  CellIndices brought(wanted.size() * n, largest);
  for (const auto &[rank, text] :
       dealii::Utilities::MPI::some_to_some(communicator, to_send))
    {
      const CellIndices cells(text, largest);
      const PlaneRange theirs = planes_of_rank(grid.cells[2], rank, n_ranks);
      std::size_t from        = 0;
      for (std::size_t k = 0; k < wanted.size(); ++k)
        if (theirs.contains(wanted[k]))
          for (std::size_t i = 0; i < n; ++i)
            brought.set(k * n + i, cells[from++]);
    }
  return brought;
}

CellIndices scatter_planes(const UniformGrid<3> &box,
                           const CellView &all,
                           const std::size_t largest,
                           const MPI_Comm communicator)
{
  const std::size_t n = box.cells_in_layer();
  const auto cells_of = [&](const unsigned int rank) {
    const PlaneRange range =
      planes_of_rank(box.cells[2], rank, mpi::n_mpi_processes(communicator));
    CellIndices cells(range.count * n, largest);
    for (std::size_t i = 0; i < range.count * n; ++i)
      cells.set(i, all[range.first * n + i]);
    return cells;
  };
  const std::string text =
    scatter(communicator, [&](const unsigned int rank) { return cells_of(rank).text(); });
  return mpi::this_mpi_process(communicator) == 0 ? cells_of(0)
                                                  : CellIndices(text, largest);
}
} // namespace mesoslip
