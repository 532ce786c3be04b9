#ifndef mesoslip_statics_voxel_voxel_grid_h
#define mesoslip_statics_voxel_voxel_grid_h

#include "grid/nodal_field.h"

#include <mpi.h>

#include <array>
#include <cstddef>
#include <vector>

namespace mesoslip::voxel
{
/** Condition on the displacement at the sides of the body. */
enum class Sides
{
  held,     ///< zero; nodes of the sides are no unknowns
  free,     ///< no condition
  periodic, ///< equal on opposite sides
  mixed     ///< some components are zero, see Level::hold(); axes may be periodic
};

/**
 * A box of cells, and which of its nodes are unknowns. Planes of nodes across z may be
 * divided among ranks. In the fields of a rank its planes are numbered from 1
 * (kernels.h), the cells between and around them from 0; planes of cells between two
 * ranks are stored by both.
 */
struct VoxelGrid
{
  std::array<unsigned int, 3> cells = {};          ///< along x, y, z
  std::array<double, 3> spacing     = {};          ///< edges of a cell, in any unit
  Sides sides                       = Sides::held; ///< all six; for a flat grid four
  std::array<bool, 3> joined        = {};          ///< for Sides::mixed: periodic axes

  /** Plane strain: one cell along y; fields have one row of nodes for both ends of y,
   * with the components along x and z. The edge along y has no effect. */
  bool flat = false;

  /** Planes of nodes below each rank and, last, of all ranks; empty: not divided. */
  std::vector<unsigned int> planes = {};
  MPI_Comm communicator            = MPI_COMM_SELF; ///< ranks that share the box
  unsigned int rank                = 0;             ///< this rank

  /** Whether the displacement is the same at both ends of an axis. */
  bool is_periodic(const unsigned int axis) const
  {
    return sides == Sides::periodic || joined[axis];
  }

  /** Whether planes are divided among ranks. */
  bool is_divided() const
  {
    return !planes.empty();
  }

  /** Number of unknown nodes of all ranks along an axis. */
  unsigned int n_all_nodes(const unsigned int axis) const
  {
    if (flat && axis == 1)
      return 1;
    return sides == Sides::held ? cells[axis] - 1 : cells[axis] + !is_periodic(axis);
  }

  /** Number of unknown nodes of this rank along an axis. */
  unsigned int n_nodes(const unsigned int axis) const
  {
    return axis == 2 && is_divided() ? planes[rank + 1] - planes[rank]
                                     : n_all_nodes(axis);
  }

  /** Planes of nodes on lower ranks. */
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

  /** Field number of the first plane of cells that no lower rank has. */
  unsigned int first_cell_plane() const
  {
    return rank == 0 ? first() : 1;
  }

  /** Number of planes of cells of the box from there on; the sum over ranks is the whole
   * box. */
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
    return !(flat && axis == 1) && (number == 0 || number == cells[axis]);
  }

  /** Length of a row of nodes or cells in numbers. */
  std::size_t stride() const
  {
    return whole_vectors<float>(n_nodes(0) + 2);
  }

  /** Components of the displacement. */
  unsigned int n_components() const
  {
    return flat ? 2 : 3;
  }

  /** Axis of component @p c. */
  unsigned int axis_of(const unsigned int c) const
  {
    return flat ? 2 * c : c;
  }

  /** Number of unit load cases. */
  unsigned int n_load_cases() const
  {
    return flat ? 3 : 6;
  }

  /** Voigt index of load case @p n and of strain component n; for a flat grid xx,
   * zz, xz. */
  unsigned int load_case(const unsigned int n) const
  {
    return flat ? 2 * n : n;
  }

  /** Rows of nodes per plane of a field, with ghosts. */
  std::size_t node_rows_in_plane() const
  {
    return flat ? 1 : std::size_t{n_nodes(1)} + 2;
  }

  /** Rows of cells per plane. */
  std::size_t cell_rows_in_plane() const
  {
    return flat ? 1 : std::size_t{n_nodes(1)} + 1;
  }

  /** Rows of nodes of a field, [z][y], with ghosts. */
  std::size_t n_node_rows() const
  {
    return node_rows_in_plane() * (n_nodes(2) + 2);
  }

  /** Rows of cells of a field, [z][y]. */
  std::size_t n_cell_rows() const
  {
    return cell_rows_in_plane() * (n_nodes(2) + 1);
  }

  /** Index of a row of nodes. */
  std::size_t node_row(const std::size_t j, const std::size_t k) const
  {
    return node_rows_in_plane() * k + (flat ? 0 : j);
  }

  /** Index of a row of cells. */
  std::size_t cell_row(const std::size_t j, const std::size_t k) const
  {
    return cell_rows_in_plane() * k + (flat ? 0 : j);
  }

  /** Ratio h_y / h of cell edges; 2 / h is the derivative along an axis. */
  double ratio(const unsigned int axis) const
  {
    return spacing[1] / spacing[axis];
  }

  /** Factor from a stiffness (Pa) to the kernels' unit: volume / (16 h_y^2), for a flat
   * grid volume / (4 h_y^2). */
  double factor() const
  {
    return spacing[0] * spacing[2] / ((flat ? 4. : 16.) * spacing[1]);
  }
};
} // namespace mesoslip::voxel

#endif
