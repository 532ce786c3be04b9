#ifndef mesoslip_statics_voxel_voxel_field_h
#define mesoslip_statics_voxel_voxel_field_h

#include "statics/voxel/planes.h"

#include <algorithm>
#include <utility>

namespace mesoslip::voxel
{
/** Displacements or forces at the nodes of a grid, as in kernels.h. */
template <typename Number>
class VoxelField
{
public:
  VoxelField() = default;

  /** A field of zeros. */
  explicit VoxelField(VoxelGrid the_grid)
    : voxels(std::move(the_grid))
    , n{{voxels.n_nodes(0), voxels.n_nodes(1), voxels.n_nodes(2)}}
    , stride(voxels.stride())
    , n_components(voxels.n_components())
    , numbers(plane_size() * (n[2] + 2) + lanes<float>)
  {
  }

  /** Numbers of component @p c at the nodes of row @p j, @p k; ghosts are row 0 and the
   *  last. */
  Number *row(const unsigned int c, const unsigned int j, const unsigned int k)
  {
    return &numbers[(voxels.node_row(j, k) * n_components + c) * stride];
  }

  /** Numbers of component @p c at the nodes of row @p j, @p k, to be read only. */
  const Number *
  row(const unsigned int c, const unsigned int j, const unsigned int k) const
  {
    return &numbers[(voxels.node_row(j, k) * n_components + c) * stride];
  }

  /** The whole field, in whole cache lines. */
  Number *data()
  {
    return numbers.data();
  }

  /** The whole field, read only. */
  const Number *data() const
  {
    return numbers.data();
  }

  /** Number of values at data(). */
  std::size_t size() const
  {
    return numbers.size();
  }

  /** Values per plane across z; the plane begins at row(0, 0, k). */
  std::size_t plane_size() const
  {
    return n_components * stride * voxels.node_rows_in_plane();
  }

  /** Updates ghosts: from the opposite side of a periodic body and from planes of other
   * ranks; remaining ghosts stay zero. Collective. */
  void set_ghosts()
  {
    if (voxels.is_periodic(0))
      for (unsigned int k = 1; k <= n[2]; ++k)
        for (unsigned int j = 1; j <= n[1]; ++j)
          for (unsigned int c = 0; c < n_components; ++c)
            {
              Number *x   = row(c, j, k);
              x[0]        = x[n[0]];
              x[n[0] + 1] = x[1];
            }
    set_ghost_rows();
  }

  /** Updates only ghosts beyond the ends of y and z. Collective. */
  void set_ghost_rows()
  {
    if (voxels.is_periodic(1) && !voxels.flat)
      for (unsigned int k = 1; k <= n[2]; ++k)
        {
          std::copy_n(row(0, n[1], k), 3 * stride, row(0, 0, k));
          std::copy_n(row(0, 1, k), 3 * stride, row(0, n[1] + 1, k));
        }
    if (voxels.is_divided())
      set_ghost_planes(voxels, data(), plane_size());
    else if (voxels.is_periodic(2))
      {
        std::copy_n(row(0, 0, n[2]), plane_size(), row(0, 0, 0));
        std::copy_n(row(0, 0, 1), plane_size(), row(0, 0, n[2] + 1));
      }
  }

  /** Grid of the field. */
  const VoxelGrid &grid() const
  {
    return voxels;
  }

  /** Numbers of locally owned nodes along the axes. */
  const std::array<unsigned int, 3> &n_nodes() const
  {
    return n;
  }

private:
  VoxelGrid voxels;
  std::array<unsigned int, 3> n = {};
  std::size_t stride            = 0;
  std::size_t n_components      = 3;
  LineVector<Number> numbers;
};

/** Calls @p action (c, j, k) for the rows of locally owned nodes. */
template <typename Action>
void for_each_row(const VoxelGrid &grid, const Action &action)
{
  for (unsigned int k = 1; k <= grid.n_nodes(2); ++k)
    for (unsigned int j = 1; j <= grid.n_nodes(1); ++j)
      for (unsigned int c = 0; c < grid.n_components(); ++c)
        action(c, j, k);
}

/** 1 for constrained components of nodes, else 0; an empty field: no constraints. */
using HeldComponents = VoxelField<float>;
} // namespace mesoslip::voxel

#endif
