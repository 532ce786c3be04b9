#ifndef mesoslip_statics_voxel_planes_h
#define mesoslip_statics_voxel_planes_h

#include "statics/voxel/voxel_grid.h"

namespace mesoslip::voxel
{
/**
 * @name Planes of divided grids
 * What the ranks tell each other. Arrays have the planes of nodes 0 to n + 1, or of cells 0
 * to n, of this rank, each of @p size numbers. Collective; nothing happens where the grid
 * is not divided, unless it is said.
 * @{
 */

/** Whether so many planes of nodes are enough for @p n_ranks: at least two for each. */
inline bool is_divided_among(const std::size_t n_planes, const unsigned int n_ranks)
{
  return n_planes >= std::size_t{2} * n_ranks;
}

/** Divides planes of nodes among the ranks of @p communicator, if they are enough. */
void divide(VoxelGrid &grid, const MPI_Comm communicator);

/** The planes of @p coarse as those of @p fine lie: nodes before the first of a rank are
 *  with the ranks before. */
void divide_as(const VoxelGrid &fine, VoxelGrid &coarse);

/** Whether each rank has at least @p n planes of nodes. */
bool has_planes(const VoxelGrid &grid, const unsigned int n);

/** Sets the planes of nodes 0 and n + 1 to those of the ranks below and above. */
template <typename Number>
void set_ghost_planes(const VoxelGrid &grid, Number *nodes, const std::size_t size);

/** Adds what the planes of nodes 0 and n + 1 hold to those of the ranks that have them. */
void add_ghost_planes(const VoxelGrid &grid, float *nodes, const std::size_t size);

/** Sums the planes of cells that two ranks have. */
void sum_shared_cells(const VoxelGrid &grid, float *cells, const std::size_t size);

/** Gives every rank the planes of all: of nodes from 1 or of cells from 0, in the places
 *  that they have in the arrays of a grid that is not divided. */
void gather_planes(const VoxelGrid &grid,
                   const float *part,
                   float *whole,
                   const std::size_t size);

/** Replaces @p n numbers by their sums over the ranks. */
void sum_over_ranks(const VoxelGrid &grid, double *values, const unsigned int n);

/** The sum over the ranks. */
inline double sum_over_ranks(const VoxelGrid &grid, double value)
{
  sum_over_ranks(grid, &value, 1);
  return value;
}
/** @} */
} // namespace mesoslip::voxel

#endif
