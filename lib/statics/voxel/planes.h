#ifndef mesoslip_statics_voxel_planes_h
#define mesoslip_statics_voxel_planes_h

#include "statics/voxel/voxel_grid.h"

namespace mesoslip::voxel
{
/**
 * @name Planes of divided grids Communication between ranks. Arrays have the planes of
 * nodes 0 to n + 1, or of cells 0 to n, of this rank, each of @p size numbers.
 * Collective; without effect on a grid that is not divided, unless documented otherwise.
 * @{
 */

/** Whether @p n_planes planes of nodes are enough for @p n_ranks: at least two per
 * rank. */
inline bool is_divided_among(const std::size_t n_planes, const unsigned int n_ranks)
{
  return n_planes >= std::size_t{2} * n_ranks;
}

/** Divides planes of nodes among the ranks of @p communicator, if there are enough. */
void divide(VoxelGrid &grid, const MPI_Comm communicator);

/** Divides the planes of @p coarse like @p fine: coarse nodes before the first node of a
 * rank belong to the ranks before it. */
void divide_as(const VoxelGrid &fine, VoxelGrid &coarse);

/** Whether each rank has at least @p n planes of nodes. */
bool has_planes(const VoxelGrid &grid, const unsigned int n);

/** Updates the ghost planes, nodes 0 and n + 1, from the ranks below and above. */
template <typename Number>
void set_ghost_planes(const VoxelGrid &grid, Number *nodes, const std::size_t size);

/** Adds the ghost planes, nodes 0 and n + 1, to the planes of their owners. */
void add_ghost_planes(const VoxelGrid &grid, float *nodes, const std::size_t size);

/** Sums the planes of cells that two ranks share. */
void sum_shared_cells(const VoxelGrid &grid, float *cells, const std::size_t size);

/** Gathers the planes of all ranks on every rank: of nodes from 1 or of cells from 0, at
 * their positions in the arrays of a replicated grid. */
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
