#ifndef mesoslip_mesh_gmsh_cell_kinds_h
#define mesoslip_mesh_gmsh_cell_kinds_h

#include "mesh/gmsh_content.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/** A mesh file and the cells to read from it. */
struct GmshFile
{
  const std::string &name; ///< path of the file
  int max_order;           ///< 2: also quadratic cells, which may be curved
};

/** For Gmsh's cell kind @p type: index of each deal.II corner among Gmsh's corners.
 * @throws UserError for a kind that is not supported */
const std::vector<unsigned int> &corners_in_order(int type, const GmshFile &file);

/** For Gmsh's quadratic cell kind @p type and each node after the corners: the deal.II
 * corners of the edge, face or cell whose middle it is. Empty for a linear kind. */
std::vector<std::vector<unsigned int>> middles_in_order(int type);

/** Checks that the mesh of @p file in the library has cells of dimension @p d, none of a
 * higher one, and in 3D of one kind.
 * @throws UserError */
void require_cells(const GmshFile &file, int d);

/** Checks that all cells of dimension @p d are among the @p n_in_groups cells of groups.
 * @throws UserError */
void require_groups(const std::string &file, int d, std::size_t n_in_groups);

/** Checks that @p faces of a 3D mesh are of the kind that its @p cells have.
 * @throws UserError */
void require_faces(const std::string &file,
                   const std::vector<GmshCells> &cells,
                   const std::vector<GmshCells> &faces);
} // namespace mesoslip

#endif
