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
 * What one rank has of a box of bricks: some layers of cells across y, so that every rank
 * has its share of bottom and top, and all their nodes. Planes of nodes between two ranks
 * are with both.
 *
 * The points of the part, which are numbered as those of mesh_of_cells(), lie as the kernels
 * want them (brick_kernel.h): plane by plane across y, in a plane row by row with x fastest.
 * Behind the planes that this rank owns come what the sides of periodic boxes repeat and
 * the plane that the rank before owns. Of a box periodic in x the rows have no last node.
 */
struct BrickSlab
{
  BrickBox box;                         ///< the whole one
  unsigned int first_plane = 0;         ///< number of the first plane of nodes in the box
  unsigned int n_planes    = 0;         ///< of nodes
  std::array<unsigned int, 2> n_nodes;  ///< distinct ones of a row, and rows of a plane
  std::vector<std::size_t> plane_start; ///< first point of each plane
  std::size_t stride = 0;               ///< of the rows of phases

  /** Of the cells of this rank and of the layers below and above, where there are such:
   * [n_planes + 1][n_nodes[1] - 1][stride]; `none` behind the rows and where there are no
   * cells. */
  CellIndices phase;
  unsigned int none = 0; ///< number of phases

  /** Without neighbours, and with no cells but those that were asked for: the kernels need
   * none. */
  MeshPart<3> part;

  /** Whether there are cells below the first plane of this rank, or above its last. */
  bool has_layer(const bool above) const
  {
    return box.periodic[1] ||
           (above ? first_plane + n_planes <= box.grid.cells[1] : first_plane > 0);
  }

  /** Of a point of the part: row and number in the row of the distinct node that it is or
   * repeats, and its plane in this slab. */
  std::array<unsigned int, 3> place_of(const unsigned int point) const;
};

/**
 * Divides the box among the ranks, of which each reads its @p phases, some layers across z at a
 * time; they are below @p n_phases. Each of @p cells becomes one of the part of the rank that
 * has it. Collective.
 * @throws UserError for more ranks than layers of cells, and what @p phases throws on one rank
 */
BrickSlab divide_box(const BrickBox &box,
                     const CellReader &phases,
                     const unsigned int n_phases,
                     const MPI_Comm communicator,
                     const std::vector<unsigned int> &cells = {});
} // namespace mesoslip

#endif
