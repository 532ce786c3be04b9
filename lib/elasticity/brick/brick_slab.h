#ifndef mesoslip_elasticity_brick_brick_slab_h
#define mesoslip_elasticity_brick_brick_slab_h

#include "grid/brick_box.h"
#include "grid/cell_indices.h"
#include "grid/cell_reader.h"
#include "mesh/mesh_part.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * The part of a box of bricks on one rank: layers of cells across y, so that every rank
 * has a share of bottom and top, and all nodes of these cells. Node planes between two
 * ranks are stored on both.
 *
 * Points of the part are numbered in the mesh as in mesh_of_cells(). Locally they are
 * ordered as the kernels need them (brick_kernel.h): plane by plane across y, row by row
 * within a plane, x fastest. After the locally owned planes come the periodic copies and
 * the plane owned by the previous rank. In a box periodic in x, rows have no last node.
 */
struct BrickSlab
{
  BrickBox box;                         ///< the whole box
  unsigned int first_plane = 0;         ///< index of the first node plane in the box
  unsigned int n_planes    = 0;         ///< number of node planes
  std::array<unsigned int, 2> n_nodes;  ///< distinct nodes per row, rows per plane
  std::vector<std::size_t> plane_start; ///< first point of each plane
  std::size_t stride = 0;               ///< length of the rows of phase

  /**
   * Phases of the cells of this rank and, if present, of the layers below and above:
   * [n_planes + 1][n_nodes[1] - 1][stride]. The value is `none` behind the rows and where
   * there are no cells.
   */
  CellIndices phase;
  unsigned int none = 0; ///< number of phases

  /**
   * Points and the requested cells. Neighbours and further cells are left out; the
   * kernels do not need them.
   */
  MeshPart<3> part;

  /**
   * Whether there are cells below the first plane of this rank or, with @p above, above
   * its last one.
   */
  bool has_layer(const bool above) const
  {
    return box.periodic[1] ||
           (above ? first_plane + n_planes <= box.grid.cells[1] : first_plane > 0);
  }

  /**
   * Row, index in the row, and plane in this slab of a point of the part; of a periodic
   * copy those of its master.
   */
  std::array<unsigned int, 3> place_of(const unsigned int point) const;
};

/**
 * Partitions the box. Each rank reads its @p phases (all below @p n_phases), some layers
 * across z at a time. Each of @p cells becomes a cell of the part of its rank.
 * Collective. @throws UserError if there are more ranks than layers of cells; exceptions
 * of @p phases on one rank
 */
BrickSlab divide_box(const BrickBox &box,
                     const CellReader &phases,
                     const unsigned int n_phases,
                     const MPI_Comm communicator,
                     const std::vector<unsigned int> &cells = {});
} // namespace mesoslip

#endif
