#include "mesh/read_gmsh.h"

#include "base/errors.h"
#include "base/text.h"
#include "mesh/cell_quality.h"
#include "mesh/gmsh_content.h"
#include "mesh/triangulation_cells.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace mesoslip
{
namespace
{
/** Moves the cells of @p content in @p some into a list; Item is Cell or Face, @p group
 * its member for the group number. */
template <typename Item>
std::vector<Item> to_cells(std::vector<GmshCells> &some,
                           const GmshContent &content,
                           unsigned int Item::*const group)
{
  std::vector<Item> cells;
  cells.reserve(count(some));
  for (GmshCells &of_kind : some)
    {
      for (std::size_t k = 0; k < of_kind.tags.size(); k += of_kind.n_nodes())
        {
          Item cell(of_kind.n_corners);
          for (std::size_t v = 0; v < of_kind.n_corners; ++v)
            cell.vertices[v] = content.place_of(of_kind.tags[k + v]);
          cell.*group = of_kind.group;
          cells.push_back(std::move(cell));
        }
      of_kind.tags = {};
    }
  return cells;
}

/** Bulges of all nodes of @p content in the middle of an edge, face or cell, once per
 * cell; corners are indices of its points. */
template <int dim>
std::vector<Bulge<dim>> bulges_of(const GmshContent &content, const double scale)
{
  constexpr double round_off = 1e-9;
  const auto point           = [&](const unsigned int place) {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = scale * content.coordinates[3UL * place + d];
    return result;
  };
  std::vector<Bulge<dim>> bulges;
  for (const GmshCells &some : content.cells)
    for (std::size_t k = 0; k < some.tags.size(); k += some.n_nodes())
      for (std::size_t m = 0; m < some.middles.size(); ++m)
        {
          Bulge<dim> bulge;
          for (const unsigned int v : some.middles[m])
            bulge.corners.push_back(content.place_of(some.tags[k + v]));
          // Relative to the first corner, to keep accuracy far from the origin.
          const dealii::Point<dim> first = point(bulge.corners[0]);
          bulge.offset =
            point(content.place_of(some.tags[k + some.n_corners + m])) - first;
          double size = 0.;
          for (const unsigned int corner : bulge.corners)
            {
              const dealii::Tensor<1, dim> away = point(corner) - first;
              size                              = std::max(size, away.norm());
              bulge.offset -= away / static_cast<double>(bulge.corners.size());
            }
          if (bulge.offset.norm() <= round_off * size)
            bulge.offset = 0.;
          bulges.push_back(std::move(bulge));
        }
  return bulges;
}

/** Removes zero bulges and copies, and sorts by corners.
 * @throws UserError if cells that share an edge or face disagree on its bulge */
template <int dim>
void sort_bulges(Mesh<dim> &mesh, const std::string &file)
{
  std::vector<Bulge<dim>> &all = mesh.bulges;
  for (Bulge<dim> &bulge : all)
    std::sort(bulge.corners.begin(), bulge.corners.end());
  std::sort(all.begin(), all.end(), [](const Bulge<dim> &a, const Bulge<dim> &b) {
    return a.corners < b.corners;
  });
  for (std::size_t k = 1; k < all.size(); ++k)
    if (all[k].corners == all[k - 1].corners &&
        !((all[k].offset - all[k - 1].offset).norm() <= 1e-6 * all[k].offset.norm()))
      throw UserError(file + ": cells that share an edge or face have different nodes in "
                             "its middle; mesh the body anew");
  all.erase(std::unique(all.begin(), all.end(),
                        [](const Bulge<dim> &a, const Bulge<dim> &b) {
                          return a.corners == b.corners;
                        }),
            all.end());
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Bulge<dim> &a) { return a.offset.norm() == 0.; }),
            all.end());
  all.shrink_to_fit();
}

/** Keeps only points of cells. */
template <int dim>
void set_points(Mesh<dim> &mesh, const GmshContent &content, const double scale)
{
  constexpr unsigned int unused = std::numeric_limits<unsigned int>::max();
  std::vector<unsigned int> number(content.point_tags.size(), unused);
  double lower_z = std::numeric_limits<double>::max(), upper_z = -lower_z, size = 0.;
  for (auto &cell : mesh.cells)
    for (unsigned int &v : cell.vertices)
      {
        if (number[v] == unused)
          {
            number[v]       = mesh.points.size();
            const double *x = &content.coordinates[3UL * v];
            dealii::Point<dim> point;
            for (unsigned int d = 0; d < dim; ++d)
              {
                point[d] = scale * x[d];
                if (!std::isfinite(point[d]))
                  throw UserError(content.file + ": point " +
                                  std::to_string(content.point_tags[v]) +
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
    throw UserError(content.file +
                    ": the surface is not in a plane z = constant, z goes "
                    "from " +
                    to_text(lower_z) + " to " + to_text(upper_z) +
                    "; plane bodies are meshed in x and y");
  // Points without a cell stay invalid, so that faces with them belong to no cell.
  for (auto &face : mesh.faces)
    for (unsigned int &v : face.vertices)
      v = number[v];
  for (auto &bulge : mesh.bulges)
    for (unsigned int &v : bulge.corners)
      v = number[v];
}

/** Reverses cells with negative volume. Cells that stay negative are left to
 * cell_quality().
 * @return number of reversed cells */
template <int dim>
std::size_t turn_cells(Mesh<dim> &mesh)
{
  std::size_t n_turned = 0;
  for (Cell &cell : mesh.cells)
    if (cell_volume(mesh.points, cell.vertices) < 0.)
      {
        std::vector<unsigned int> &v = cell.vertices;
        if (v.size() == 8)
          std::swap_ranges(v.begin(), v.begin() + 4, v.begin() + 4);
        else
          std::swap(v[1], v[2]);
        ++n_turned;
      }
  return n_turned;
}

/** Gives cells a positive volume; deal.II also wants consistent edge directions in
 * quadrilaterals and hexahedra. */
template <int dim>
void orient(Mesh<dim> &mesh)
{
  mesh.n_turned = turn_cells(mesh);
  if (!std::all_of(mesh.cells.begin(), mesh.cells.end(),
                   [](const Cell &cell) { return cell.vertices.size() == 1U << dim; }))
    return;
  auto cells = to_dealii<dim>(std::exchange(mesh.cells, {}));
  dealii::GridTools::consistently_order_cells(cells);
  mesh.cells = from_dealii<dim>(cells);
}

/** Returns free memory to the system: many small pieces would lie idle beside the large
 * arrays of the run. */
void give_back_memory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}
} // namespace

template <int dim>
Mesh<dim>
read_gmsh(const std::string &file, const double scale, const unsigned int max_order)
{
  Assert(scale > 0., dealii::ExcMessage("a scale is positive"));
  if (std::filesystem::path(file).extension() != ".msh")
    throw UserError("Mesh/File = " + file +
                    " does not end in .msh; only meshes that Gmsh "
                    "wrote are read (4.1 or 2.2)");
  if (!std::ifstream(file))
    throw UserError("Mesh/File = " + file + " cannot be opened; check the name");
  Mesh<dim> mesh;
  {
    GmshContent content(file, dim, static_cast<int>(max_order));
    give_back_memory();
    mesh.phases     = content.phases;
    mesh.boundaries = content.boundaries;
    mesh.bulges     = bulges_of<dim>(content, scale);
    mesh.cells      = to_cells(content.cells, content, &Cell::material_id);
    mesh.faces      = to_cells(content.faces, content, &Face::boundary_id);
    set_points(mesh, content, scale);
    sort_bulges(mesh, file);
  }
  give_back_memory();
  orient(mesh);
  give_back_memory();
  return mesh;
}

template Mesh<2> read_gmsh(const std::string &, const double, const unsigned int);
template Mesh<3> read_gmsh(const std::string &, const double, const unsigned int);
} // namespace mesoslip
