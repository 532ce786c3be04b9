#ifndef mesoslip_statics_voxel_voxel_grid_h
#define mesoslip_statics_voxel_voxel_grid_h

#include "grid/nodal_field.h"

#include <mpi.h>

#include <array>
#include <cstddef>
#include <vector>

namespace mesoslip::voxel
{
/** What is said about the displacement at the sides of the body. */
enum class Sides
{
  held,     ///< zero, so that the nodes of the sides are no unknowns
  free,     ///< nothing
  periodic, ///< the same on opposite ones
  mixed     ///< some components are zero, see VoxelGrid::held
};

/** Whether the displacement along axis c is zero on the two sides across an axis:
 *  [across][c]. */
using HeldComponents = std::array<std::array<bool, 3>, 3>;

/**
 * A box of cells and which of its nodes are unknowns. Planes of nodes across z may be
 * divided among ranks: those of this rank are numbered from 1 in its fields (kernels.h),
 * the cells between them and around them from 0; planes of cells between two ranks are
 * with both.
 */
struct VoxelGrid
{
  std::array<unsigned int, 3> cells = {};          ///< numbers along x, y, z, of the box
  std::array<double, 3> spacing     = {};          ///< edges of a cell, in any unit
  Sides sides                       = Sides::held; ///< all six
  HeldComponents held               = {};          ///< of Sides::mixed

  /** Planes of nodes below those of each rank and, last, of all; empty: not divided. */
  std::vector<unsigned int> planes = {};
  MPI_Comm communicator            = MPI_COMM_SELF; ///< of the ranks
  unsigned int rank                = 0;             ///< this one

  /** Whether other ranks have a part of it. */
  bool is_divided() const
  {
    return !planes.empty();
  }

  /** Number of nodes of all ranks that are unknowns along an axis. */
  unsigned int n_all_nodes(const unsigned int axis) const
  {
    return cells[axis] + (sides == Sides::free || sides == Sides::mixed) -
           (sides == Sides::held);
  }

  /** Number of those of this rank. */
  unsigned int n_nodes(const unsigned int axis) const
  {
    return axis == 2 && is_divided() ? planes[rank + 1] - planes[rank]
                                     : n_all_nodes(axis);
  }

  /** Planes of nodes on the ranks before. */
  unsigned int below() const
  {
    return is_divided() ? planes[rank] : 0;
  }

  /** Number in a field (kernels.h) of the first node and of the first cell of the box, in
   *  z on rank 0. */
  unsigned int first() const
  {
    return sides == Sides::held ? 0 : 1;
  }

  /** Number in a field of the first plane of cells that this rank and no one before has. */
  unsigned int first_cell_plane() const
  {
    return rank == 0 ? first() : 1;
  }

  /** How many planes of cells of the box begin there: those of all ranks are all. */
  unsigned int n_cell_planes() const
  {
    const unsigned int beyond = below() + n_nodes(2) + 1 - first();
    const unsigned int before = below() + first_cell_plane() - first();
    return (beyond < cells[2] ? beyond : cells[2]) - before;
  }

  /** Whether node number @p i of this rank along an axis (Sides::free or mixed) is on a side
   *  across it. */
  bool is_on_side(const unsigned int axis, const unsigned int i) const
  {
    const unsigned int number = i - 1 + (axis == 2 ? below() : 0);
    return number == 0 || number == cells[axis];
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
} // namespace mesoslip::voxel

#endif
