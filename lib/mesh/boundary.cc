#include "mesh/boundary.h"

#include "base/errors.h"
#include "mesh/linear_cell.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace mesoslip
{
namespace
{
/** A face by its points in ascending order, the same for all cells that share it. */
template <int dim>
struct SortedFace
{
  std::array<unsigned int, BoundaryFace<dim>::max_points> key;
  unsigned int cell;
  unsigned int number; ///< face number in the cell

  bool operator<(const SortedFace &other) const
  {
    return key < other.key;
  }
};

template <int dim>
std::array<unsigned int, BoundaryFace<dim>::max_points>
sorted_points(const unsigned int *points, const unsigned int n)
{
  std::array<unsigned int, BoundaryFace<dim>::max_points> key;
  key.fill(dealii::numbers::invalid_unsigned_int);
  std::copy_n(points, n, key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

/** Face @p number of a cell. */
template <int dim>
BoundaryFace<dim>
face_of_cell(const Mesh<dim> &mesh, const unsigned int k, const unsigned int number)
{
  const auto &vertices = mesh.cells[k].vertices;
  const LinearCell<dim> reference(vertices.size());
  BoundaryFace<dim> face;
  face.cell     = k;
  face.n_points = 0;
  for (const unsigned int v : reference.corners_of_face(number))
    face.points[face.n_points++] = vertices[v];
  return face;
}

template <int dim>
unsigned int n_faces(const Cell &cell)
{
  return LinearCell<dim>(cell.vertices.size()).n_faces();
}

/** For each point p the cells with a face whose smallest point is p, once per such face;
 * they begin at first[p]. */
struct CellsBySmallestPoint
{
  template <int dim>
  explicit CellsBySmallestPoint(const Mesh<dim> &mesh)
    : first(mesh.points.size() + 2, 0)
  {
    const auto for_each = [&mesh](const auto &visit) {
      for (unsigned int k = 0; k < mesh.cells.size(); ++k)
        for (unsigned int f = 0; f < n_faces<dim>(mesh.cells[k]); ++f)
          {
            const BoundaryFace<dim> face = face_of_cell(mesh, k, f);
            visit(
              *std::min_element(face.points.begin(), face.points.begin() + face.n_points),
              k);
          }
    };
    // Counted two places on, so that after filling the lists the offsets are in place.
    for_each([this](const unsigned int p, const unsigned int) { ++first[p + 2]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    cells.resize(first.back());
    for_each(
      [this](const unsigned int p, const unsigned int k) { cells[first[p + 1]++] = k; });
  }

  std::vector<std::size_t> first;
  std::vector<unsigned int> cells;
};

/** Calls @p visit with the cell faces that have equal points, for all faces of the mesh
 * in ascending order. No list of all faces is stored: a hexahedron has six. */
template <int dim, typename Visit>
void visit_faces(const Mesh<dim> &mesh, const Visit &visit)
{
  const CellsBySmallestPoint lists(mesh);
  std::vector<SortedFace<dim>> faces, same;
  for (unsigned int p = 0; p < mesh.points.size(); ++p)
    {
      faces.clear();
      for (std::size_t i = lists.first[p]; i < lists.first[p + 1]; ++i)
        if (const unsigned int k = lists.cells[i];
            i == lists.first[p] || k != lists.cells[i - 1])
          for (unsigned int f = 0; f < n_faces<dim>(mesh.cells[k]); ++f)
            {
              const BoundaryFace<dim> face = face_of_cell(mesh, k, f);
              const auto key = sorted_points<dim>(face.points.data(), face.n_points);
              if (key[0] == p)
                faces.push_back({key, k, f});
            }
      std::sort(faces.begin(), faces.end());
      for (auto begin = faces.begin(), end = begin; begin != faces.end(); begin = end)
        {
          end = std::find_if(begin, faces.end(),
                             [&](const auto &face) { return face.key != begin->key; });
          same.assign(begin, end);
          visit(same);
        }
    }
}

/** Outward normal times the Jacobian of a line, or at a corner (m^(dim-1)). */
dealii::Tensor<1, 2> normal(const std::array<dealii::Tensor<1, 2>, 1> &tangent)
{
  return dealii::cross_product_2d(tangent[0]);
}

dealii::Tensor<1, 3> normal(const std::array<dealii::Tensor<1, 3>, 2> &tangent)
{
  return dealii::cross_product_3d(tangent[0], tangent[1]);
}

/** Distance of the cell centre from the plane of one of its faces times the area of the
 * face; negative on the other side. */
template <int dim>
double
height_over(const Mesh<dim> &mesh, const BoundaryFace<dim> &face, const unsigned int cell)
{
  const auto corner = [&](const unsigned int v) { return mesh.points[face.points[v]]; };
  std::array<dealii::Tensor<1, dim>, dim - 1> tangent = {{corner(1) - corner(0)}};
  if constexpr (dim == 3)
    tangent = face.n_points == 3
                ? decltype(tangent){{corner(1) - corner(0), corner(2) - corner(0)}}
                : decltype(tangent){{corner(3) - corner(0), corner(2) - corner(1)}};
  dealii::Tensor<1, dim> height;
  for (unsigned int v = 0; v < face.n_points; ++v)
    height -= corner(v) / static_cast<double>(face.n_points);
  const auto &vertices = mesh.cells[cell].vertices;
  for (const unsigned int p : vertices)
    height += mesh.points[p] / static_cast<double>(vertices.size());
  return height * normal(tangent);
}

/** Integrals of normal times shape function; their sign is not oriented outwards. */
template <int dim>
std::vector<dealii::Tensor<1, dim>> tributary_areas(const Mesh<dim> &mesh,
                                                    const BoundaryFace<dim> &face)
{
  const LinearCell<dim - 1> cell(face.n_points);
  const auto quadrature = cell.quadrature();
  std::vector<dealii::Tensor<1, dim>> areas(face.n_points);
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      const dealii::Point<dim - 1> &xi = quadrature.point(q);
      std::array<dealii::Tensor<1, dim>, dim - 1> tangent;
      for (unsigned int v = 0; v < face.n_points; ++v)
        for (unsigned int d = 0; d + 1 < dim; ++d)
          tangent[d] += mesh.points[face.points[v]] * cell.gradient(xi, v)[d];
      for (unsigned int v = 0; v < face.n_points; ++v)
        areas[v] += quadrature.weight(q) * cell.shape(xi, v) * normal(tangent);
    }
  return areas;
}
} // namespace

template <int dim>
std::vector<BoundaryFace<dim>> boundary_faces(const Mesh<dim> &mesh)
{
  std::vector<BoundaryFace<dim>> result;
  boost::disjoint_sets_with_storage<> pieces(mesh.cells.size());
  for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    pieces.make_set(k);
  std::size_t n_pieces = mesh.cells.size();
  visit_faces(mesh, [&](const std::vector<SortedFace<dim>> &same) {
    const SortedFace<dim> &one = same.front(), &other = same.back();
    const BoundaryFace<dim> face = face_of_cell(mesh, one.cell, one.number);
    const bool overlap =
      same.size() == 2 &&
      !(height_over(mesh, face, one.cell) * height_over(mesh, face, other.cell) < 0.);
    if (same.size() > 2 || overlap)
      throw UserError("Mesh/File: " + std::to_string(same.size()) + " cells share the " +
                      (dim == 2 ? "edge" : "face") + " at " + place_of(mesh, face) +
                      (overlap ? " and lie on the same side of it" : "") +
                      "; cells overlap or are there twice, look at the mesh" +
                      (overlap ? ", which may be folded there" : ""));
    if (same.size() == 1)
      result.push_back(face);
    else if (pieces.find_set(one.cell) != pieces.find_set(other.cell))
      {
        pieces.union_set(one.cell, other.cell);
        --n_pieces;
      }
  });
  if (n_pieces != 1)
    throw UserError("Mesh/File: the body is in " + std::to_string(n_pieces) +
                    " pieces that share no " + (dim == 2 ? "edges" : "faces") +
                    "; let parts share their boundary (in Gmsh: BooleanFragments or "
                    "Coherence), or mesh them apart");
  return result;
}

template <int dim>
std::vector<std::array<unsigned int, 2>> neighbouring_cells(const Mesh<dim> &mesh)
{
  std::vector<std::array<unsigned int, 2>> pairs;
  pairs.reserve(mesh.cells.size() * dim); // fewer for simplices
  visit_faces(mesh, [&pairs](const std::vector<SortedFace<dim>> &same) {
    for (std::size_t k = 1; k < same.size(); ++k)
      pairs.push_back({{same[k - 1].cell, same[k].cell}});
  });
  return pairs;
}

template <int dim>
BoundaryPoints<dim> boundary_points(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &faces)
{
  std::map<unsigned int, dealii::Tensor<1, dim>> areas;
  for (const BoundaryFace<dim> &face : faces)
    {
      std::vector<dealii::Tensor<1, dim>> of_face = tributary_areas(mesh, face);
      // Outwards: away from the cell centre.
      const auto &corners = mesh.cells[face.cell].vertices;
      dealii::Tensor<1, dim> out, total;
      for (unsigned int v = 0; v < face.n_points; ++v)
        {
          out += mesh.points[face.points[v]] / static_cast<double>(face.n_points);
          total += of_face[v];
        }
      for (const unsigned int v : corners)
        out -= mesh.points[v] / static_cast<double>(corners.size());
      const double sign = out * total > 0. ? 1. : -1.;
      for (unsigned int v = 0; v < face.n_points; ++v)
        areas[face.points[v]] += sign * of_face[v];
    }
  BoundaryPoints<dim> result;
  for (const auto &[point, area] : areas)
    {
      result.points.push_back(point);
      result.normal_area.push_back(area);
    }
  return result;
}

template <int dim>
std::vector<BoundaryFace<dim>> faces_of_group(const Mesh<dim> &mesh,
                                              const std::vector<BoundaryFace<dim>> &faces,
                                              const unsigned int boundary)
{
  std::vector<std::array<unsigned int, BoundaryFace<dim>::max_points>> group;
  for (const auto &face : mesh.faces)
    if (face.boundary_id == boundary)
      group.push_back(sorted_points<dim>(face.vertices.data(), face.vertices.size()));
  std::sort(group.begin(), group.end());
  std::vector<BoundaryFace<dim>> result;
  for (const BoundaryFace<dim> &face : faces)
    if (std::binary_search(group.begin(), group.end(),
                           sorted_points<dim>(face.points.data(), face.n_points)))
      result.push_back(face);
  return result;
}

#define MESOSLIP_INSTANTIATE(dim)                                                       \
  template std::vector<BoundaryFace<dim>> boundary_faces(const Mesh<dim> &);            \
  template std::vector<std::array<unsigned int, 2>> neighbouring_cells(                 \
    const Mesh<dim> &);                                                                 \
  template BoundaryPoints<dim> boundary_points(const Mesh<dim> &,                       \
                                               const std::vector<BoundaryFace<dim>> &); \
  template std::vector<BoundaryFace<dim>> faces_of_group(                               \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const unsigned int);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
