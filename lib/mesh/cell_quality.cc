#include "mesh/cell_quality.h"

#include "base/errors.h"
#include "base/text.h"
#include "mesh/curved/curved_cells.h"

#include <deal.II/grid/grid_tools.h>

#include <limits>

namespace mesoslip
{
namespace
{
/** Corners at the other ends of the edges from corner @p v, right-handed. */
template <int dim>
std::array<unsigned int, dim> neighbours(const unsigned int v, const bool is_simplex)
{
  std::array<unsigned int, dim> result;
  for (unsigned int d = 0; d < dim; ++d)
    result[d] = is_simplex ? (v + 1 + d) % (dim + 1) : v ^ (1U << d);
  // Each step to the lower end of an axis mirrors; in a tetrahedron, each step to the
  // next corner.
  const bool mirrored = is_simplex ? dim == 3 && v % 2 == 1
                                   : ((v & 1U) + ((v >> 1U) & 1U) + (v >> 2U)) % 2 == 1;
  if (mirrored)
    std::swap(result[0], result[1]);
  return result;
}

template <int dim>
std::vector<double> coordinates(const dealii::Point<dim> &point)
{
  std::vector<double> x(dim);
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = point[d];
  return x;
}

/** Throws if the sixteen digits of the largest coordinate leave fewer than seven for an
 * edge. */
template <int dim>
void require_near_origin(const Mesh<dim> &mesh, const double largest_edge)
{
  constexpr double largest_ratio = 1e9;
  for (const dealii::Point<dim> &point : mesh.points)
    if (const double distance = point.norm();
        distance > largest_ratio * largest_edge && largest_edge > 0.)
      throw UserError("Mesh/File: a point lies " + to_text(distance) +
                      " m from the origin, too far for edges of " +
                      to_text(largest_edge) +
                      " m, whose length its digits hardly tell; mesh the body near the "
                      "origin");
}
} // namespace

template <int dim>
double cell_volume(const std::vector<dealii::Point<dim>> &points,
                   const std::vector<unsigned int> &vertices)
{
  // Relative coordinates: deal.II would multiply absolute ones.
  std::vector<dealii::Point<dim>> corners;
  std::vector<unsigned int> numbers;
  for (const unsigned int v : vertices)
    {
      numbers.push_back(static_cast<unsigned int>(numbers.size()));
      corners.emplace_back(points[v] - points[vertices[0]]);
    }
  return dealii::GridTools::cell_measure(corners,
                                         dealii::ArrayView<const unsigned int>(numbers));
}

template <int dim>
MeshQuality<dim> cell_quality(const Mesh<dim> &mesh)
{
  MeshQuality<dim> quality;
  quality.smallest_edge = std::numeric_limits<double>::max();
  quality.volume.assign(mesh.phases.size(), 0.);
  quality.n_cells.assign(mesh.phases.size(), 0);
  for (const Cell &cell : mesh.cells)
    {
      const auto &corners = cell.vertices;
      quality.volume[cell.material_id] += cell_volume(mesh.points, corners);
      ++quality.n_cells[cell.material_id];
      for (unsigned int v = 0; v < corners.size(); ++v)
        {
          dealii::Tensor<2, dim> edges;
          double lengths  = 1.;
          const auto ends = neighbours<dim>(v, corners.size() == dim + 1);
          for (unsigned int d = 0; d < dim; ++d)
            {
              edges[d] = mesh.points[corners[ends[d]]] - mesh.points[corners[v]];
              const double length   = edges[d].norm();
              quality.smallest_edge = std::min(quality.smallest_edge, length);
              quality.largest_edge  = std::max(quality.largest_edge, length);
              lengths *= length;
            }
          const double jacobian = lengths > 0. ? determinant(edges) / lengths : 0.;
          if (!(jacobian >= quality.worst_jacobian))
            {
              quality.worst_jacobian = jacobian;
              quality.worst_place    = dealii::Point<dim>();
              for (const unsigned int p : corners)
                quality.worst_place +=
                  mesh.points[p] / static_cast<double>(corners.size());
            }
        }
    }
  for (const CurvedCell &curved : curved_cells(mesh))
    {
      const Cell &cell = mesh.cells[curved.cell];
      quality.volume[cell.material_id] +=
        curved.volume - cell_volume(mesh.points, cell.vertices);
      if (!(curved.least_jacobian > 0.))
        throw UserError("Mesh/File: the curved cell with a corner at (" +
                        to_text(coordinates(mesh.points[cell.vertices[0]])) +
                        ") m is turned inside out at a point, as its edges bulge too "
                        "far; mesh that place finer or let Gmsh improve it "
                        "(Mesh.HighOrderOptimize = 1)");
    }
  require_near_origin(mesh, quality.largest_edge);
  if (!(quality.worst_jacobian > 1e-10))
    {
      throw UserError("Mesh/File: the cell at (" +
                      to_text(coordinates(quality.worst_place)) +
                      ") m is twisted, concave or flat (scaled Jacobian " +
                      to_text(quality.worst_jacobian) +
                      "); mesh that place anew, for instance with another algorithm");
    }
  return quality;
}

template double cell_volume(const std::vector<dealii::Point<2>> &,
                            const std::vector<unsigned int> &);
template double cell_volume(const std::vector<dealii::Point<3>> &,
                            const std::vector<unsigned int> &);
template MeshQuality<2> cell_quality(const Mesh<2> &);
template MeshQuality<3> cell_quality(const Mesh<3> &);
} // namespace mesoslip
