#include "mesh/boundary.h"

#include "base/errors.h"
#include "base/text.h"

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/grid/reference_cell.h>

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace mesoslip
{
namespace
{
/** A face of a cell by its points in ascending order, the same for all that share it. As
 * small as can be: there are six of each hexahedron. */
template <int dim>
struct SortedFace
{
  std::array<unsigned int, BoundaryFace<dim>::max_points> key;
  unsigned int cell;
  unsigned int number; ///< of the face in the cell

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
  const auto cell      = dealii::ReferenceCell::n_vertices_to_type(dim, vertices.size());
  BoundaryFace<dim> face;
  face.cell     = k;
  face.n_points = cell.face_reference_cell(number).n_vertices();
  for (unsigned int v = 0; v < face.n_points; ++v)
    face.points[v] = vertices[cell.face_to_cell_vertices(number, v, 1)];
  return face;
}

template <int dim>
std::vector<SortedFace<dim>> faces_of_cells(const Mesh<dim> &mesh)
{
  const auto n_faces = [](const auto &cell) {
    return dealii::ReferenceCell::n_vertices_to_type(dim, cell.vertices.size()).n_faces();
  };
  std::size_t n = 0;
  for (const auto &cell : mesh.cells)
    n += n_faces(cell);
  std::vector<SortedFace<dim>> faces;
  faces.reserve(n);
  for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    for (unsigned int f = 0; f < n_faces(mesh.cells[k]); ++f)
      {
        const BoundaryFace<dim> face = face_of_cell(mesh, k, f);
        faces.push_back({sorted_points<dim>(face.points.data(), face.n_points), k, f});
      }
  std::sort(faces.begin(), faces.end());
  return faces;
}

template <int dim>
std::string place(const Mesh<dim> &mesh, const std::vector<unsigned int> &points)
{
  dealii::Point<dim> centre;
  for (const unsigned int p : points)
    centre += mesh.points[p] / static_cast<double>(points.size());
  std::vector<double> x(dim);
  for (unsigned int d = 0; d < dim; ++d)
    x[d] = centre[d];
  return "(" + to_text(x) + ") m";
}

/** Outward normal times the Jacobian at the corner or, for a line, of it (m^(dim-1)). */
dealii::Tensor<1, 2> normal(const std::array<dealii::Tensor<1, 2>, 1> &tangent)
{
  return dealii::cross_product_2d(tangent[0]);
}

dealii::Tensor<1, 3> normal(const std::array<dealii::Tensor<1, 3>, 2> &tangent)
{
  return dealii::cross_product_3d(tangent[0], tangent[1]);
}

/** Integrals of normal times shape function; their sign is not that of the outside. */
template <int dim>
std::vector<dealii::Tensor<1, dim>> tributary_areas(const Mesh<dim> &mesh,
                                                    const BoundaryFace<dim> &face)
{
  const auto cell = dealii::ReferenceCell::n_vertices_to_type(dim - 1, face.n_points);
  const auto quadrature = cell.template get_gauss_type_quadrature<dim - 1>(2);
  std::vector<dealii::Tensor<1, dim>> areas(face.n_points);
  for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      const dealii::Point<dim - 1> &xi = quadrature.point(q);
      std::array<dealii::Tensor<1, dim>, dim - 1> tangent;
      for (unsigned int v = 0; v < face.n_points; ++v)
        for (unsigned int d = 0; d + 1 < dim; ++d)
          tangent[d] += mesh.points[face.points[v]] *
                        cell.template d_linear_shape_function_gradient<dim - 1>(xi, v)[d];
      for (unsigned int v = 0; v < face.n_points; ++v)
        areas[v] += quadrature.weight(q) *
                    cell.template d_linear_shape_function<dim - 1>(xi, v) *
                    normal(tangent);
    }
  return areas;
}
} // namespace

template <int dim>
std::vector<BoundaryFace<dim>> boundary_faces(const Mesh<dim> &mesh)
{
  const std::vector<SortedFace<dim>> faces = faces_of_cells(mesh);
  std::vector<BoundaryFace<dim>> result;
  boost::disjoint_sets_with_storage<> pieces(mesh.cells.size());
  for (unsigned int k = 0; k < mesh.cells.size(); ++k)
    pieces.make_set(k);
  std::size_t n_pieces = mesh.cells.size();
  for (auto first = faces.begin(), last = first; first != faces.end(); first = last)
    {
      while (last != faces.end() && last->key == first->key)
        ++last;
      const BoundaryFace<dim> face = face_of_cell(mesh, first->cell, first->number);
      if (last - first > 2)
        throw UserError(
          "Mesh/File: " + std::to_string(last - first) + " cells share the " +
          (dim == 2 ? "edge" : "face") + " at " +
          place(mesh, {face.points.begin(), face.points.begin() + face.n_points}) +
          "; cells overlap or are there twice, look at the mesh");
      if (last - first == 1)
        result.push_back(face);
      else if (pieces.find_set(first->cell) != pieces.find_set((last - 1)->cell))
        {
          pieces.link(first->cell, (last - 1)->cell);
          --n_pieces;
        }
    }
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
  const std::vector<SortedFace<dim>> faces = faces_of_cells(mesh);
  std::vector<std::array<unsigned int, 2>> pairs;
  pairs.reserve(faces.size() / 2);
  for (std::size_t k = 1; k < faces.size(); ++k)
    if (faces[k - 1].key == faces[k].key)
      pairs.push_back({{faces[k - 1].cell, faces[k].cell}});
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
      // Outwards is away from the middle of the cell.
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

template <int dim>
std::array<std::vector<BoundaryFace<dim>>, 2UL * dim>
faces_of_box(const Mesh<dim> &mesh, const std::vector<BoundaryFace<dim>> &faces)
{
  const dealii::BoundingBox<dim> box(mesh.points);
  std::array<std::vector<BoundaryFace<dim>>, 2UL * dim> sides;
  for (const BoundaryFace<dim> &face : faces)
    {
      const auto is_on = [&](const unsigned int side) {
        const unsigned int axis = side / 2;
        const double level =
          side % 2 == 0 ? box.lower_bound(axis) : box.upper_bound(axis);
        return std::all_of(face.points.begin(), face.points.begin() + face.n_points,
                           [&](const unsigned int p) {
                             return std::fabs(mesh.points[p][axis] - level) <=
                                    1e-9 * box.side_length(axis);
                           });
      };
      unsigned int side = 0;
      while (side < 2 * dim && !is_on(side))
        ++side;
      if (side == 2 * dim)
        throw UserError(
          "Mesh/File: the boundary at " +
          place(mesh, {face.points.begin(), face.points.begin() + face.n_points}) +
          " is on no side of the bounding box; a volume element has to be "
          "a box without holes (make a hole a phase with a small modulus)");
      sides[side].push_back(face);
    }
  return sides;
}

template std::vector<BoundaryFace<2>> boundary_faces(const Mesh<2> &);
template std::vector<BoundaryFace<3>> boundary_faces(const Mesh<3> &);
template std::vector<std::array<unsigned int, 2>> neighbouring_cells(const Mesh<3> &);
template std::vector<std::array<unsigned int, 2>> neighbouring_cells(const Mesh<2> &);
template BoundaryPoints<2> boundary_points(const Mesh<2> &,
                                           const std::vector<BoundaryFace<2>> &);
template BoundaryPoints<3> boundary_points(const Mesh<3> &,
                                           const std::vector<BoundaryFace<3>> &);
template std::vector<BoundaryFace<2>>
faces_of_group(const Mesh<2> &, const std::vector<BoundaryFace<2>> &, const unsigned int);
template std::vector<BoundaryFace<3>>
faces_of_group(const Mesh<3> &, const std::vector<BoundaryFace<3>> &, const unsigned int);
template std::array<std::vector<BoundaryFace<2>>, 4>
faces_of_box(const Mesh<2> &, const std::vector<BoundaryFace<2>> &);
template std::array<std::vector<BoundaryFace<3>>, 6>
faces_of_box(const Mesh<3> &, const std::vector<BoundaryFace<3>> &);
} // namespace mesoslip
