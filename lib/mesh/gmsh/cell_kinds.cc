#include "mesh/gmsh/cell_kinds.h"

#include "base/errors.h"

#include <gmsh.h>

#include <numeric>
#include <set>

namespace mesoslip
{
namespace
{
/** A kind of cell in Gmsh and deal.II. */
struct CellKind
{
  int gmsh_type;                    ///< type number in the file
  int order;                        ///< 1 or 2
  std::vector<unsigned int> corner; ///< Gmsh corner of each deal.II corner
};

const std::vector<CellKind> cell_kinds = {{15, 1, {0}},
                                          {1, 1, {0, 1}},
                                          {2, 1, {0, 1, 2}},
                                          {3, 1, {0, 1, 3, 2}},
                                          {4, 1, {0, 1, 2, 3}},
                                          {5, 1, {0, 1, 3, 2, 4, 5, 7, 6}},
                                          {8, 2, {0, 1}},
                                          {9, 2, {0, 1, 2}},
                                          {10, 2, {0, 1, 3, 2}},
                                          {11, 2, {0, 1, 2, 3}},
                                          {12, 2, {0, 1, 3, 2, 4, 5, 7, 6}}};
} // namespace

const std::vector<unsigned int> &corners_in_order(const int type, const GmshFile &file)
{
  for (const CellKind &kind : cell_kinds)
    if (kind.gmsh_type == type && kind.order <= file.max_order)
      return kind.corner;
  std::string name;
  int d = 0, order = 0, n = 0, n_primary = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, name, d, order, n, local, n_primary);
  const std::string advice =
    order == 1 ? "mesoslip reads triangles and quadrilaterals, tetrahedra or hexahedra"
    : order == 2 && file.max_order > 1
      ? "set Mesh.SecondOrderIncomplete = 0 in Gmsh, for a node in the middle of each "
        "edge, face and cell"
      : "set Mesh.ElementOrder = 1 in Gmsh" +
          std::string(order > 2 ? "" : "; a volume may have them with Mesh/Degree = 2");
  throw UserError(file.name + " has cells of the kind '" + name + "'; " + advice);
}

std::vector<std::vector<unsigned int>> middles_in_order(const int type)
{
  std::string name;
  int d = 0, order = 0, n = 0, n_corners = 0;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(type, name, d, order, n, local, n_corners);
  // Whether a node belongs to a deal.II corner, from Gmsh's parametric coordinates:
  // barycentric on simplices, otherwise from -1 to 1 along axes.
  const auto is_around = [&](const unsigned int corner, const double *const at) {
    if (n_corners == d + 1 && d > 1)
      return (corner > 0 ? at[corner - 1] : 1. - std::accumulate(at, at + d, 0.)) > 1e-6;
    for (int axis = 0; axis < d; ++axis)
      if ((corner >> axis & 1U ? 1. : -1.) * at[axis] < -1e-6)
        return false;
    return true;
  };
  std::vector<std::vector<unsigned int>> middles;
  for (int node = n_corners; node < n; ++node)
    {
      middles.emplace_back();
      for (int corner = 0; corner < n_corners; ++corner)
        if (is_around(corner, &local[static_cast<std::size_t>(node) * d]))
          middles.back().push_back(corner);
    }
  return middles;
}

namespace
{
/** Corners of the kinds of cells of dimension @p d. */
std::set<std::size_t> kinds_of_cells(const int d, const GmshFile &file)
{
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, d);
  std::set<std::size_t> n_corners;
  for (const int type : types)
    n_corners.insert(corners_in_order(type, file).size());
  return n_corners;
}

/** Cells of dimension @p d, 2 or 3, that the library holds. */
std::size_t n_cells(const int d)
{
  const std::vector<std::string> kinds =
    d == 2 ? std::vector<std::string>{"Triangles", "Quadrangles"}
           : std::vector<std::string>{"Tetrahedra", "Hexahedra"};
  std::size_t n = 0;
  for (const std::string &kind : kinds)
    {
      double of_kind = 0.;
      gmsh::option::getNumber("Mesh.Nb" + kind, of_kind);
      n += static_cast<std::size_t>(of_kind);
    }
  return n;
}
} // namespace

void require_cells(const GmshFile &file, const int d)
{
  if (d < 3 && !kinds_of_cells(d + 1, file).empty())
    throw UserError(file.name + " has cells of dimension 3; set Dimension = 3");
  const std::size_t n_kinds = kinds_of_cells(d, file).size();
  if (n_kinds == 0)
    throw UserError(file.name + " has no cells of dimension " + std::to_string(d) + "; " +
                    (d == 2 ? "mesh the surfaces"
                     : kinds_of_cells(2, file).empty()
                       ? "mesh the volumes"
                       : "set Dimension = 2 if the body is "
                         "plane, else mesh the volumes") +
                    " (gmsh -" + std::to_string(d) + ")");
  if (d == 3 && n_kinds > 1)
    throw UserError(file.name +
                    " has hexahedra and tetrahedra, which share no faces; mesh all "
                    "volumes with one kind");
}

void require_faces(const std::string &file,
                   const std::vector<GmshCells> &cells,
                   const std::vector<GmshCells> &faces)
{
  const bool are_hexahedra = cells.front().n_corners == 8;
  for (const GmshCells &some : faces)
    if (some.n_corners != (are_hexahedra ? 4 : 3))
      throw UserError(file + " has " +
                      (are_hexahedra ? "triangles as faces of hexahedra"
                                     : "quadrilaterals as faces of tetrahedra") +
                      "; save faces and cells of one mesh");
}

void require_groups(const std::string &file, const int d, const std::size_t n_in_groups)
{
  const std::size_t n = n_cells(d);
  if (n == n_in_groups)
    return;
  // Gmsh returns only cells of one order for a part of the geometry.
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, corners;
  gmsh::model::mesh::getElements(types, tags, corners, d);
  std::size_t n_given = 0;
  for (const auto &of_type : tags)
    n_given += of_type.size();
  if (n_given < n)
    throw UserError(file + ": " + std::to_string(n - n_given) + " of " +
                    std::to_string(n) +
                    " cells are of another order than others; set "
                    "Mesh.ElementOrder = 1 in Gmsh and mesh again");
  throw UserError(file + ": " + std::to_string(n - n_in_groups) + " of " +
                  std::to_string(n) + " cells belong to no physical group; give each " +
                  (d == 2 ? "surface" : "volume") +
                  " a group with the name of its phase, and save only groups");
}
} // namespace mesoslip
