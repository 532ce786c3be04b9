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

  /** Whether plane @p number is one of them. */
  bool contains(const unsigned int number) const
  {
    return number >= first && number < first + count;
  }
};

/** The planes that rank @p rank has of @p n_planes: from r N / n to (r + 1) N / n. */
PlaneRange planes_of_rank(const unsigned int n_planes,
                          const unsigned int rank,
                          const unsigned int n_ranks);

/** The same for this rank of @p communicator. */
PlaneRange own_planes(const unsigned int n_planes, const MPI_Comm communicator);

/**
 * What the cells of a box are made of, of which each rank has its planes_of_rank(). The
 * numbers are stored elsewhere.
 */
class CellPlanes
{
public:
  /** @p of_rank are the cells of the planes of this rank, x fastest. Of the same @p box and
   * @p ranks everywhere. */
  CellPlanes(const UniformGrid<3> &box, const CellView &of_rank, const MPI_Comm ranks);

  /** Of @p all cells, which every rank has. */
  static CellPlanes
  of_whole(const UniformGrid<3> &box, const CellView &all, const MPI_Comm ranks);

  /** The cells of the planes with these numbers, in this order, x fastest; none is above @p
   * largest. Every rank asks for planes of its own. Collective. */
  CellIndices bring(const std::vector<unsigned int> &wanted,
                    const std::size_t largest) const;

  const UniformGrid<3> grid;   ///< the whole box
  const CellView own;          ///< the numbers of the cells in the planes of this rank
  const MPI_Comm communicator; ///< of the ranks that have the planes
};

/** The cells of the planes of this rank, of @p all those of @p box that rank 0 has; none is
 * above @p largest. Collective. */
CellIndices scatter_planes(const UniformGrid<3> &box,
                           const CellView &all,
                           const std::size_t largest,
                           const MPI_Comm communicator);
} // namespace mesoslip

#endif
