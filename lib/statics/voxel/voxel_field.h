#ifndef mesoslip_statics_voxel_voxel_field_h
#define mesoslip_statics_voxel_voxel_field_h

#include "grid/nodal_field.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace mesoslip::voxel
{
/** What is said about the displacement at the sides of the body. */
enum class Sides
{
  held,    ///< zero, so that the nodes of the sides are no unknowns
  free,    ///< nothing
  periodic ///< the same on opposite ones
};

/** A box of cells and which of its nodes are unknowns. */
struct VoxelGrid
{
  std::array<unsigned int, 3> cells = {};          ///< numbers along x, y, z
  std::array<double, 3> spacing     = {};          ///< edges of a cell, in any unit
  Sides sides                       = Sides::held; ///< all six

  /** Number of nodes that are unknowns along an axis. */
  unsigned int n_nodes(const unsigned int axis) const
  {
    return cells[axis] + (sides == Sides::free) - (sides == Sides::held);
  }

  /** Number in a field (kernels.h) of the first node and of the first cell. */
  unsigned int first() const
  {
    return sides == Sides::held ? 0 : 1;
  }

  /** Length of a row of nodes or cells in numbers. */
  std::size_t stride() const
  {
    return whole_vectors<float>(n_nodes(0) + 2);
  }

  /** Rows of cells, [z][y]. */
  std::size_t n_cell_rows() const
  {
    return (std::size_t{n_nodes(1)} + 1) * (n_nodes(2) + 1);
  }

  /** 2 / h is the derivative along an axis; this is h_y / h. */
  double ratio(const unsigned int axis) const
  {
    return spacing[1] / spacing[axis];
  }

  /** What turns a stiffness (Pa) into that of the kernels: volume / (16 h_y^2). */
  double factor() const
  {
    return spacing[0] * spacing[2] / (16. * spacing[1]);
  }
};

/** Three components at the nodes of a grid, as in kernels.h. */
template <typename Number>
class VoxelField
{
public:
  VoxelField() = default;

  /** All zero. */
  explicit VoxelField(const VoxelGrid &grid)
    : n{{grid.n_nodes(0), grid.n_nodes(1), grid.n_nodes(2)}}
    , periodic(grid.sides == Sides::periodic)
    , stride(grid.stride())
    , numbers((std::size_t{n[1]} + 2) * (n[2] + 2) * 3 * stride + lanes<float>)
  {
  }

  /** Numbers of component @p c at the nodes of row @p j, @p k; ghosts are row 0 and the
   *  last. */
  Number *row(const unsigned int c, const unsigned int j, const unsigned int k)
  {
    return &numbers[((std::size_t{n[1] + 2} * k + j) * 3 + c) * stride];
  }

  /** The same to read. */
  const Number *
  row(const unsigned int c, const unsigned int j, const unsigned int k) const
  {
    return &numbers[((std::size_t{n[1] + 2} * k + j) * 3 + c) * stride];
  }

  /** Whole field, in whole cache lines. */
  Number *data()
  {
    return numbers.data();
  }

  /** The same to read. */
  const Number *data() const
  {
    return numbers.data();
  }

  /** Numbers at data(). */
  std::size_t size() const
  {
    return numbers.size();
  }

  /** Copies of the other side of a periodic body; others keep their zeros. */
  void set_ghosts()
  {
    if (periodic)
      for (unsigned int k = 1; k <= n[2]; ++k)
        for (unsigned int j = 1; j <= n[1]; ++j)
          for (unsigned int c = 0; c < 3; ++c)
            {
              Number *x   = row(c, j, k);
              x[0]        = x[n[0]];
              x[n[0] + 1] = x[1];
            }
    set_ghost_rows();
  }

  /** Those beyond the ends of y and z only. */
  void set_ghost_rows()
  {
    if (!periodic)
      return;
    for (unsigned int k = 1; k <= n[2]; ++k)
      {
        std::copy_n(row(0, n[1], k), 3 * stride, row(0, 0, k));
        std::copy_n(row(0, 1, k), 3 * stride, row(0, n[1] + 1, k));
      }
    const std::size_t plane = 3 * stride * (n[1] + 2);
    std::copy_n(row(0, 0, n[2]), plane, row(0, 0, 0));
    std::copy_n(row(0, 0, 1), plane, row(0, 0, n[2] + 1));
  }

  /** Numbers of nodes, without ghosts. */
  const std::array<unsigned int, 3> &n_nodes() const
  {
    return n;
  }

private:
  std::array<unsigned int, 3> n = {};
  bool periodic                 = false;
  std::size_t stride            = 0;
  LineVector<Number> numbers;
};
} // namespace mesoslip::voxel

#endif
