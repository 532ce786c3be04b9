#ifndef mesoslip_mesh_read_gmsh_h
#define mesoslip_mesh_read_gmsh_h

#include "mesh/mesh.h"

namespace mesoslip
{
/**
 * Reads a mesh of Gmsh from @p file: format 2.2 or 4.1, as text or binary, with
 * triangles and quadrilaterals (dim = 2, in a plane z = constant) or with tetrahedra and
 * hexahedra (dim = 3), of order 1 or, up to @p max_order, 2. Phases and boundaries are
 * the physical groups; a group without a name is named by its number. Points without a
 * cell are dropped. Coordinates are multiplied by @p scale (m per unit of the file).
 *
 * The Gmsh library reads the file, on the calling rank. Cells get positive volume:
 * clockwise numbering is reversed. No further checks; see check_mesh().
 * @throws UserError if the file cannot be read or has cells of other kinds, cells
 * without a group or in two groups, or points outside the plane
 */
template <int dim>
Mesh<dim>
read_gmsh(const std::string &file, const double scale, const unsigned int max_order = 1);
} // namespace mesoslip

#endif
