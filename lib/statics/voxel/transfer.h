#ifndef mesoslip_statics_voxel_transfer_h
#define mesoslip_statics_voxel_transfer_h

#include "statics/voxel/level.h"
#include "statics/voxel/voxel_field.h"

#include <array>
#include <vector>

namespace mesoslip::voxel
{
/**
 * Transfer between a grid and a coarser one of the same box, both uniform: linear
 * interpolation by position, also if nodes do not coincide (odd numbers of cells).
 */
class Transfer
{
public:
  /** Sets up the transfer between the given grids. */
  Transfer(const VoxelGrid &fine, const VoxelGrid &coarse);

  /** b = P^T r; ghosts of @p r are not read, ghosts of @p b are overwritten.
   * Collective. */
  void restrict_to(const VoxelField<float> &r, VoxelField<float> &b);

  /** x += P c; ghosts of @p c must be set, ghosts of @p x are not updated. */
  void add_from(const VoxelField<float> &c, VoxelField<float> &x);

private:
  /** Positions of fine nodes between coarse nodes along an axis. */
  struct Axis
  {
    std::vector<unsigned int> left; ///< coarse node at or before the fine one
    std::vector<float> weight;      ///< weight of the next coarse node
    bool halves = false;            ///< even numbers of cells: two to one
  };
  static Axis axis(const VoxelGrid &fine, const VoxelGrid &coarse, const unsigned int d);
  void restrict_row(const float *fine, float *coarse) const;
  void add_row(const float *coarse, float *fine) const;

  VoxelGrid coarse_grid;
  std::array<unsigned int, 3> n_fine, n_coarse; ///< nodes of this rank
  std::size_t fine_stride, coarse_stride;
  unsigned int n_components;
  std::array<bool, 3> periodic;
  unsigned int first;
  std::array<Axis, 3> axes;
  LineVector<float> line;
};

/** Coefficients of a coarser grid: means by volume. Collective. */
CellStiffness
coarsened(const VoxelGrid &fine, CellStiffness &stiffness, const VoxelGrid &coarse);

/** Constraints of a coarser grid: a node is constrained if all fine nodes around its
 * position are. Ghosts are set. Collective. */
HeldComponents coarsened(const HeldComponents &fine, const VoxelGrid &coarse);

/** The next coarser grid: half as many cells along the axes with short cells; divided
 * like @p grid. */
VoxelGrid coarser(const VoxelGrid &grid);
} // namespace mesoslip::voxel

#endif
