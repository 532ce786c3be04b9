#ifndef mesoslip_statics_voxel_multigrid_h
#define mesoslip_statics_voxel_multigrid_h

#include "statics/voxel/level.h"
#include "statics/voxel/transfer.h"

#include <Eigen/Core>

#include <deque>
#include <vector>

namespace mesoslip::voxel
{
/**
 * Preconditioner for the stiffness of voxels, in single precision: one symmetric V cycle
 * with Chebyshev smoothers on every grid. Coarse grids have averaged stiffness; a
 * prototype with Galerkin operators took as many iterations. Coarser grids are smoothed
 * more: inclusions that touch on a coarse but not on a fine grid are resolved only by
 * the latter, and steps on the coarse one cost an eighth.
 *
 * Grids with few planes per rank are replicated: every rank does the same work there.
 * All members are collective.
 */
class Multigrid
{
public:
  /** Smoothing of grid 0, and growth of the degree from grid to grid. */
  struct Options
  {
    Smoothing finest;           ///< smoothing of grid 0
    unsigned int growth   = 1;  ///< factor of the degree from grid to grid
    unsigned int greatest = 32; ///< largest degree
  };

  /** Takes the finest grid; ghost cells of @p stiffness and ghosts of @p held must be
   * set. */
  Multigrid(const VoxelGrid &grid,
            CellStiffness &&stiffness,
            const Options &options,
            HeldComponents held);

  /** Sets constrained components of Sides::mixed, whose ghosts must be set, and
   * @p springs; springs of coarse grids follow from the share of forces that their nodes
   * take. */
  void hold(HeldComponents held, Springs springs = {});

  /** @p solution = M^-1 @p force; ghosts of @p solution are set. */
  void vmult(VoxelField<float> &solution, const VoxelField<float> &force);

  /** The finest level, grid 0. */
  Level &finest()
  {
    return levels.front();
  }

  /** A field of grid 0 that vmult() overwrites. */
  VoxelField<float> &finest_buffer()
  {
    return d.front();
  }

private:
  void
  visit(const std::size_t l, VoxelField<float> &solution, const VoxelField<float> &force);
  void add_level(VoxelGrid grid, CellStiffness &&stiffness, HeldComponents &held);
  void assemble_bottom();
  void invert_bottom();
  void solve_bottom(VoxelField<float> &solution, const VoxelField<float> &force) const;

  std::deque<Level> levels;
  std::vector<Transfer> transfers; ///< transfers[l] is between grids l and l + 1
  std::vector<Smoothing> smoothings;
  std::vector<VoxelField<float>> x, b, d; ///< x and b of grid 0 are the caller's

  /** The first replicated grid after a partitioned one, if any; parts of its x and b in
   * the partition of the grid before it. */
  std::size_t first_whole = 0;
  VoxelField<float> part_x, part_b;
  Eigen::MatrixXd bottom;         ///< stiffness of the coarsest grid, unconstrained
  Eigen::MatrixXd bottom_inverse; ///< its pseudo-inverse with constraints
};
} // namespace mesoslip::voxel

#endif
