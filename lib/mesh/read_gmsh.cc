#include "mesh/read_gmsh.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_tools.h>

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace mesoslip
{
namespace
{
/** The Gmsh library between its start and its end, without output of its own. */
class GmshLibrary
{
public:
  GmshLibrary()
  {
    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
  }

  GmshLibrary(const GmshLibrary &)            = delete;
  GmshLibrary &operator=(const GmshLibrary &) = delete;

  ~GmshLibrary()
  {
    gmsh::finalize();
  }
};

/** Cells of one kind in Gmsh and in deal.II. */
struct CellKind
{
  int gmsh_type;                    ///< as in the file
  std::vector<unsigned int> corner; ///< of Gmsh, in the order of deal.II
};

const std::vector<CellKind> cell_kinds = {
  {15, {0}},         {1, {0, 1}},       {2, {0, 1, 2}},
  {3, {0, 1, 3, 2}}, {4, {0, 1, 2, 3}}, {5, {0, 1, 3, 2, 4, 5, 7, 6}}};

class GmshReader
{
public:
  explicit GmshReader(const std::string &file)
    : file(file)
  {
    std::vector<double> parametric;
    gmsh::model::mesh::getNodes(tags, coordinates, parametric);
    place.resize(tags.size());
    std::iota(place.begin(), place.end(), 0U);
    std::sort(place.begin(), place.end(),
              [this](const auto a, const auto b) { return tags[a] < tags[b]; });
  }

  /** All cells (d = dim) or faces (d = dim - 1) that belong to physical groups. */
  template <int d>
  std::vector<dealii::CellData<d>> cells(std::vector<std::string> &names)
  {
    std::vector<dealii::CellData<d>> result;
    std::map<int, std::string> group_of_entity;
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, d);
    for (const auto &[dimension, group] : groups)
      {
        std::string name;
        gmsh::model::getPhysicalName(dimension, group, name);
        names.push_back(name.empty() ? std::to_string(group) : name);
        std::vector<int> entities;
        gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
        for (const int entity : entities)
          {
            const auto [other, is_first] = group_of_entity.emplace(entity, names.back());
            if (!is_first)
              throw UserError(file + ": part " + std::to_string(entity) +
                              " of the geometry is in two physical groups, '" +
                              other->second + "' and '" + names.back() +
                              "'; put it into one");
            append(result, names.size() - 1, entity);
          }
      }
    return result;
  }

  /** Throws unless the mesh has cells of dimension @p d, none of a higher one, and each
   * of them is in a group. */
  void require_groups(const unsigned int d, const std::size_t n_in_groups) const
  {
    const std::size_t n = n_cells(d);
    if (n == 0 || (d < 3 && n_cells(d + 1) > 0))
      throw UserError(file + " has " + std::to_string(n) + " cells of dimension " +
                      std::to_string(d) + (n == 0 ? "" : " and others of dimension 3") +
                      "; set Dimension to that of the mesh");
    if (n != n_in_groups)
      throw UserError(file + ": " + std::to_string(n - n_in_groups) + " of " +
                      std::to_string(n) +
                      " cells belong to no physical group; give each " +
                      (d == 2 ? "surface" : "volume") +
                      " a group with the name of its phase, and save only groups");
  }

  const std::string file;          ///< its name
  std::vector<std::size_t> tags;   ///< of the points
  std::vector<double> coordinates; ///< three a point, in units of the file

private:
  static std::size_t n_cells(const int d)
  {
    std::size_t n = 0;
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, d);
    for (const auto &[dimension, entity] : entities)
      {
        std::vector<int> types;
        gmsh::model::mesh::getElementTypes(types, dimension, entity);
        for (const int type : types)
          {
            std::vector<std::size_t> cells, corners;
            gmsh::model::mesh::getElementsByType(type, cells, corners, entity);
            n += cells.size();
          }
      }
    return n;
  }

  std::vector<unsigned int> place; ///< in the list, in the order of the tags

  /** Of a tag in the list. */
  unsigned int place_of(const std::size_t tag) const
  {
    const auto found =
      std::lower_bound(place.begin(), place.end(), tag,
                       [this](const auto k, const auto t) { return tags[k] < t; });
    AssertThrow(found != place.end() && tags[*found] == tag,
                dealii::ExcMessage("Gmsh gave a cell with a point that it did not give"));
    return *found;
  }

  template <int d>
  void append(std::vector<dealii::CellData<d>> &cells,
              const std::size_t group,
              const int entity) const
  {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> cell_tags, nodes;
    gmsh::model::mesh::getElements(types, cell_tags, nodes, d, entity);
    for (std::size_t t = 0; t < types.size(); ++t)
      {
        const CellKind &kind = kind_of(types[t]);
        const std::size_t n  = kind.corner.size();
        for (std::size_t k = 0; k < cell_tags[t].size(); ++k)
          {
            dealii::CellData<d> cell(n);
            for (std::size_t v = 0; v < n; ++v)
              cell.vertices[v] = place_of(nodes[t][k * n + kind.corner[v]]);
            cell.material_id = group; // or boundary_id, a union of the two
            cells.push_back(std::move(cell));
          }
        cell_tags[t] = {};
        nodes[t]     = {};
      }
  }

  const CellKind &kind_of(const int type) const
  {
    for (const CellKind &kind : cell_kinds)
      if (kind.gmsh_type == type)
        return kind;
    std::string name;
    int d = 0, order = 0, n = 0, n_primary = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, d, order, n, local, n_primary);
    throw UserError(file + " has cells of the kind '" + name + "'; " +
                    (order > 1 ? "set Mesh.ElementOrder = 1 in Gmsh"
                               : "mesoslip reads triangles and quadrilaterals, "
                                 "tetrahedra or hexahedra"));
  }
};

/** Keeps the points that cells use. */
template <int dim>
void set_points(Mesh<dim> &mesh, const GmshReader &reader, const double scale)
{
  constexpr unsigned int unused = std::numeric_limits<unsigned int>::max();
  std::vector<unsigned int> number(reader.tags.size(), unused);
  double lower_z = std::numeric_limits<double>::max(), upper_z = -lower_z, size = 0.;
  for (auto &cell : mesh.cells)
    for (unsigned int &v : cell.vertices)
      {
        if (number[v] == unused)
          {
            number[v]       = mesh.points.size();
            const double *x = &reader.coordinates[3UL * v];
            dealii::Point<dim> point;
            for (unsigned int d = 0; d < dim; ++d)
              {
                point[d] = scale * x[d];
                if (!std::isfinite(point[d]))
                  throw UserError(reader.file + ": point " +
                                  std::to_string(reader.tags[v]) +
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
    throw UserError(reader.file +
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

/** What is in the file, without the library's copy of it, which is several times as large.
 */
template <int dim>
Mesh<dim> read_with_gmsh(const std::string &file, const double scale)
{
  try
    {
      const GmshLibrary library;
      gmsh::merge(file);
      GmshReader reader(file);
      Mesh<dim> mesh;
      mesh.cells = reader.cells<dim>(mesh.phases);
      reader.require_groups(dim, mesh.cells.size());
      mesh.faces = reader.cells<dim - 1>(mesh.boundaries);
      set_points(mesh, reader, scale);
      return mesh;
    }
  catch (const std::string &message)
    {
      throw UserError(file + " cannot be read by Gmsh: " + message);
    }
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
  Mesh<dim> mesh = read_with_gmsh<dim>(file, scale);
  give_back_memory();
  dealii::GridTools::invert_cells_with_negative_measure(mesh.points, mesh.cells);
  order_edges(mesh);
  give_back_memory();
  return mesh;
}

template Mesh<2> read_gmsh(const std::string &, const double);
template Mesh<3> read_gmsh(const std::string &, const double);
} // namespace mesoslip
