#include "mesh/read_gmsh.h"

#include "base/errors.h"
#include "base/text.h"
#include "mesh/gmsh/msh_file.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace mesoslip
{
namespace
{
/** Cells of one kind in Gmsh and in deal.II. */
struct CellKind
{
  int gmsh_type;                    ///< as in the file
  std::vector<unsigned int> corner; ///< of Gmsh, in the order of deal.II
};

const std::vector<CellKind> cell_kinds = {
  {15, {0}},         {1, {0, 1}},       {2, {0, 1, 2}},
  {3, {0, 1, 3, 2}}, {4, {0, 1, 2, 3}}, {5, {0, 1, 3, 2, 4, 5, 7, 6}}};

const CellKind &kind_of(const int type)
{
  for (const CellKind &kind : cell_kinds)
    if (kind.gmsh_type == type)
      return kind;
  AssertThrow(false, dealii::ExcMessage("read_msh() gave elements of another kind"));
}

/** All cells (d = dim) or faces (d = dim - 1) that belong to physical groups. They are gone
 * from the file then. */
template <int d>
std::vector<dealii::CellData<d>> take_cells(MshFile &msh, std::vector<std::string> &names)
{
  std::size_t n = 0;
  for (const auto &[block, corners] : msh.blocks)
    if (block.dim == d && block.group != 0)
      n += corners.size() / kind_of(block.type).corner.size();
  std::vector<dealii::CellData<d>> result;
  result.reserve(n);
  int group = 0;
  for (auto &[block, corners] : msh.blocks)
    if (block.dim == d && block.group != 0)
      {
        if (block.group != group)
          {
            group            = block.group;
            const auto named = msh.names.find({{d, group}});
            names.push_back(named == msh.names.end() || named->second.empty()
                              ? std::to_string(group)
                              : named->second);
          }
        const std::vector<unsigned int> &corner = kind_of(block.type).corner;
        while (!corners.empty())
          {
            auto &cell = result.emplace_back(corner.size());
            for (std::size_t v = 0; v < corner.size(); ++v)
              cell.vertices[v] = corners[corner[v]];
            cell.material_id = names.size() - 1; // or boundary_id, a union of the two
            corners.erase(corners.begin(), corners.begin() + corner.size());
          }
      }
  return result;
}

/** Throws unless the mesh has cells of dimension @p d, none of a higher one, and each
 * of them is in a group. */
void require_groups(const MshFile &msh, const int d, const std::string &file)
{
  std::size_t n = 0, n_in_groups = 0, n_higher = 0;
  for (const auto &[block, corners] : msh.blocks)
    {
      const std::size_t n_here = corners.size() / kind_of(block.type).corner.size();
      if (block.dim == d)
        n += n_here;
      if (block.dim == d && block.group != 0)
        n_in_groups += n_here;
      if (block.dim > d)
        n_higher += n_here;
    }
  if (n == 0 || n_higher > 0)
    throw UserError(file + " has " + std::to_string(n) + " cells of dimension " +
                    std::to_string(d) + (n == 0 ? "" : " and others of dimension 3") +
                    "; set Dimension to that of the mesh");
  if (n != n_in_groups)
    throw UserError(file + ": " + std::to_string(n - n_in_groups) + " of " +
                    std::to_string(n) + " cells belong to no physical group; give each " +
                    (d == 2 ? "surface" : "volume") +
                    " a group with the name of its phase, and save only groups");
}

/** Keeps the points that cells use. */
template <int dim>
void set_points(Mesh<dim> &mesh,
                const MshFile &msh,
                const std::string &file,
                const double scale)
{
  constexpr unsigned int unused = std::numeric_limits<unsigned int>::max();
  std::vector<unsigned int> number(msh.tags.size(), unused);
  mesh.points.reserve(msh.tags.size());
  double lower_z = std::numeric_limits<double>::max(), upper_z = -lower_z, size = 0.;
  for (auto &cell : mesh.cells)
    for (unsigned int &v : cell.vertices)
      {
        if (number[v] == unused)
          {
            number[v]       = mesh.points.size();
            const double *x = &msh.coordinates[3UL * v];
            dealii::Point<dim> point;
            for (unsigned int d = 0; d < dim; ++d)
              {
                point[d] = scale * x[d];
                if (!std::isfinite(point[d]))
                  throw UserError(file + ": point " + std::to_string(msh.tags[v]) +
                                  " has a coordinate that is no finite number");
                size = std::max(size, std::fabs(x[d]));
              }
            lower_z = std::min(lower_z, x[2]);
            upper_z = std::max(upper_z, x[2]);
            mesh.points.push_back(point);
          }
        v = number[v];
      }
  if (dim == 2 && !(upper_z - lower_z <= 1e-9 * size))
    throw UserError(file +
                    ": the surface is not in a plane z = constant, z goes "
                    "from " +
                    to_text(lower_z) + " to " + to_text(upper_z) +
                    "; plane bodies are meshed in x and y");
  // Faces in groups that bound no cell go.
  auto &faces = mesh.faces;
  for (auto &face : faces)
    for (unsigned int &v : face.vertices)
      v = number[v];
  faces.erase(std::remove_if(faces.begin(), faces.end(),
                             [unused](const auto &face) {
                               return std::count(face.vertices.begin(),
                                                 face.vertices.end(), unused) > 0;
                             }),
              faces.end());
}

/** deal.II wants the edges of quadrilaterals and hexahedra to run alike in all cells. */
template <int dim>
void order_edges(Mesh<dim> &mesh)
{
  if (std::all_of(mesh.cells.begin(), mesh.cells.end(),
                  [](const auto &cell) { return cell.vertices.size() == 1U << dim; }))
    dealii::GridTools::consistently_order_cells(mesh.cells);
}

/** What is in the file, whose own lists are gone afterwards. */
template <int dim>
Mesh<dim> mesh_of_file(const std::string &file, const double scale)
{
  MshFile msh = read_msh(file, dim - 1);
  require_groups(msh, dim, file);
  Mesh<dim> mesh;
  mesh.cells = take_cells<dim>(msh, mesh.phases);
  mesh.faces = take_cells<dim - 1>(msh, mesh.boundaries);
  set_points(mesh, msh, file, scale);
  return mesh;
}

/** Returns what is free to the system: many small pieces that would lie idle beside the
 * large ones of the run. */
void give_back_memory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}
} // namespace

template <int dim>
Mesh<dim> read_gmsh(const std::string &file, const double scale)
{
  Assert(scale > 0., dealii::ExcMessage("a scale is positive"));
  if (std::filesystem::path(file).extension() != ".msh")
    throw UserError("Mesh/File = " + file +
                    " does not end in .msh; only meshes that Gmsh "
                    "wrote are read (4.1 or 2.2)");
  if (!std::ifstream(file))
    throw UserError("Mesh/File = " + file + " cannot be opened; check the name");
  Mesh<dim> mesh = mesh_of_file<dim>(file, scale);
  give_back_memory();
  dealii::GridTools::invert_cells_with_negative_measure(mesh.points, mesh.cells);
  order_edges(mesh);
  give_back_memory();
  return mesh;
}

template Mesh<2> read_gmsh(const std::string &, const double);
template Mesh<3> read_gmsh(const std::string &, const double);
} // namespace mesoslip
