#ifndef mesoslip_grid_cell_planes_h
#define mesoslip_grid_cell_planes_h

#include "grid/cell_indices.h"
#include "grid/uniform_grid.h"

#include <mpi.h>

#include <vector>

namespace mesoslip
{
/** Consecutive planes of cells of a box across one of its axes. */
struct PlaneRange
{
  unsigned int first = 0; ///< number of the first plane
  unsigned int count = 0; ///< number of planes

  /** Whether the range contains plane @p number. */
  bool contains(const unsigned int number) const
  {
    return number >= first && number < first + count;
  }
};

/**
 * Planes of rank r = @p rank out of n = @p n_ranks: from r N / n to (r + 1) N / n, with N
 * = @p n_planes.
 */
PlaneRange planes_of_rank(const unsigned int n_planes,
                          const unsigned int rank,
                          const unsigned int n_ranks);

/** Planes of this rank of @p communicator. */
PlaneRange own_planes(const unsigned int n_planes, const MPI_Comm communicator);

/**
 * Phases or materials of the cells of a box, distributed over the ranks by
 * planes_of_rank(). The caller owns the memory.
 */
class CellPlanes
{
public:
  /**
   * @p of_rank are the cells in the planes of this rank, x fastest. @p box and @p ranks
   * are the same on all ranks.
   */
  CellPlanes(const UniformGrid<3> &box, const CellView &of_rank, const MPI_Comm ranks);

  /** Distributes @p all cells of a box, which every rank has. */
  static CellPlanes
  of_whole(const UniformGrid<3> &box, const CellView &all, const MPI_Comm ranks);

  /**
   * Cells of the @p wanted planes in this order, x fastest; none exceeds @p largest. Each
   * rank asks for its own list. Collective.
   */
  CellIndices bring(const std::vector<unsigned int> &wanted,
                    const std::size_t largest) const;

  const UniformGrid<3> grid;   ///< the whole box
  const CellView own;          ///< cells in the planes of this rank
  const MPI_Comm communicator; ///< ranks that share the planes
};

/**
 * Sends each rank the cells of its planes. Only rank 0 needs @p all cells of @p box; none
 * exceeds @p largest. Collective.
 */
CellIndices scatter_planes(const UniformGrid<3> &box,
                           const CellView &all,
                           const std::size_t largest,
                           const MPI_Comm communicator);
} // namespace mesoslip

#endif
