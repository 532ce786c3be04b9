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
 * Preconditioner for the stiffness of voxels, in single precision: one V cycle, symmetric,
 * with Chebyshev's smoother on every grid and means of the stiffness on the coarse ones,
 * with which a prototype took as many iterations as with Galerkin operators. Coarser
 * grids are smoothed more: inclusions that touch on a coarse grid and not on a fine one are
 * moved by the latter alone, and steps there cost an eighth.
 *
 * Grids with few planes a rank are not divided: every rank does the same there. All
 * members are collective.
 */
class Multigrid
{
public:
  /** Smoothing of grid 0, and by how much the degree grows from grid to grid. */
  struct Options
  {
    Smoothing finest;           ///< of grid 0
    unsigned int growth   = 1;  ///< of the degree, from grid to grid
    unsigned int greatest = 32; ///< degree
  };

  /** Takes the finest grid; ghost cells of @p stiffness and ghosts of @p held are set. */
  Multigrid(const VoxelGrid &grid,
            CellStiffness &&stiffness,
            const Options &options,
            HeldComponents held);

  /** Holds other components of Sides::mixed, whose ghosts are set, and nodes by @p springs, of which
   *  coarse grids have what their nodes take of forces. */
  void hold(HeldComponents held, Springs springs = {});

  /** @p solution = M^-1 @p force; ghosts of @p solution are set. */
  void vmult(VoxelField<float> &solution, const VoxelField<float> &force);

  /** Grid 0. */
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
  std::vector<Transfer> transfers; ///< from grid l to l + 1
  std::vector<Smoothing> smoothings;
  std::vector<VoxelField<float>> x, b, d; ///< x and b of grid 0 are the caller's

  /** The first grid that is not divided and follows one that is, if any; parts of its x and
   *  b as the latter is divided. */
  std::size_t first_whole = 0;
  VoxelField<float> part_x, part_b;
  Eigen::MatrixXd bottom; ///< stiffness of the coarsest grid, without holds and springs
  Eigen::MatrixXd bottom_inverse; ///< its pseudo-inverse with them
};
} // namespace mesoslip::voxel

#endif
