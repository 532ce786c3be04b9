#ifndef mesoslip_mesh_gmsh_cell_kinds_h
#define mesoslip_mesh_gmsh_cell_kinds_h

#include "mesh/gmsh_content.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/** A file and the cells that are read of it. */
struct GmshFile
{
  const std::string &name; ///< its path
  int max_order;           ///< 2: also quadratic cells, which may be curved
};

/** Of a cell of Gmsh's kind @p type: which of its corners are those of deal.II. @throws UserError
 * of a kind that is not read */
const std::vector<unsigned int> &corners_in_order(int type, const GmshFile &file);

/** Of a quadratic cell of Gmsh's kind @p type, for each node after the corners, in its order: which corners of deal.II
 * the edge, face or cell has whose middle it is. Empty of a linear one. */
std::vector<std::vector<unsigned int>> middles_in_order(int type);

/** That the mesh in the library, of @p file, has cells of dimension @p d, none of a higher one, and
 * in 3D of one kind. @throws UserError */
void require_cells(const GmshFile &file, int d);

/** That each cell of dimension @p d is one of @p n_in_groups. @throws UserError */
void require_groups(const std::string &file, int d, std::size_t n_in_groups);

/** That @p faces of a 3D mesh are of the kind that its @p cells have. @throws UserError */
void require_faces(const std::string &file,
                   const std::vector<GmshCells> &cells,
                   const std::vector<GmshCells> &faces);
} // namespace mesoslip

#endif
