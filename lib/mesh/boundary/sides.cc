#include "base/errors.h"
#include "base/text.h"
#include "mesh/boundary.h"
#include "mesh/curved/curved_cells.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace mesoslip
{
template <int dim>
std::size_t n_faces_in_file(const Mesh<dim> &mesh, const unsigned int boundary)
{
  return std::count_if(mesh.faces.begin(), mesh.faces.end(),
                       [boundary](const Face &f) { return f.boundary_id == boundary; });
}

template <int dim>
std::string why_not_found(const Mesh<dim> &mesh,
                          const std::vector<BoundaryFace<dim>> &found,
                          const unsigned int boundary)
{
  const auto sorted = [](auto vertices) {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  std::set<std::vector<unsigned int>> of_body, of_file;
  for (const BoundaryFace<dim> &face : found)
    of_body.insert(sorted(std::vector<unsigned int>(
      face.points.begin(), face.points.begin() + face.n_points)));
  for (const Face &face : mesh.faces)
    if (face.boundary_id == boundary && !of_file.insert(sorted(face.vertices)).second)
      return "are listed twice; leave each there once";
  const auto place = [&mesh](const unsigned int p) {
    std::vector<double> x(dim);
    for (unsigned int d = 0; d < dim; ++d)
      x[d] = mesh.points[p][d];
    return x;
  };
  std::map<std::vector<double>, unsigned int> of_missing;
  for (const auto &face : of_file)
    for (const unsigned int p : face)
      if (of_body.count(face) == 0 && p < mesh.points.size())
        of_missing.emplace(place(p), p);
  for (unsigned int q = 0; q < mesh.points.size() && !of_missing.empty(); ++q)
    if (const auto same = of_missing.find(place(q));
        same != of_missing.end() && same->second != q)
      return "are not on the boundary of the body, as a point of them is there twice, at "
             "(" +
             to_text(same->first) +
             ") m; make one of the two, in Gmsh with Coherence Mesh";
  return "are not on the boundary of the body; take them out of it";
}

template <int dim>
std::string place_of(const Mesh<dim> &mesh, const BoundaryFace<dim> &face)
{
  std::vector<double> x(dim);
  for (unsigned int v = 0; v < face.n_points; ++v)
    for (unsigned int d = 0; d < dim; ++d)
      x[d] += mesh.points[face.points[v]][d] / face.n_points;
  return "(" + to_text(x) + ") m";
}

template <int dim>
double shortest_edge(const Mesh<dim> &mesh, const BoundaryFace<dim> &face)
{
  double shortest = std::numeric_limits<double>::infinity();
  for (unsigned int v = 0; v < face.n_points; ++v)
    for (unsigned int w = 0; w < v; ++w)
      shortest = std::min(
        shortest, mesh.points[face.points[v]].distance(mesh.points[face.points[w]]));
  return shortest;
}

template <int dim>
std::array<std::vector<BoundaryFace<dim>>, 2UL * dim>
faces_of_box(const Mesh<dim> &mesh, const std::vector<BoundaryFace<dim>> &faces)
{
  const dealii::BoundingBox<dim> box(mesh.points);
  std::array<std::vector<BoundaryFace<dim>>, 2UL * dim> sides;
  for (const BoundaryFace<dim> &face : faces)
    {
      const double off = mesh.tolerance * shortest_edge(mesh, face);
      const auto is_on = [&](const unsigned int side) {
        const unsigned int axis = side / 2;
        const double level =
          side % 2 == 0 ? box.lower_bound(axis) : box.upper_bound(axis);
        return std::all_of(face.points.begin(), face.points.begin() + face.n_points,
                           [&](const unsigned int p) {
                             return std::fabs(mesh.points[p][axis] - level) <= off;
                           }) &&
               bulge_of_face<dim>(
                 mesh, {face.points.begin(), face.points.begin() + face.n_points},
                 axis) <= off;
      };
      unsigned int side = 0;
      while (side < 2 * dim && !is_on(side))
        ++side;
      if (side == 2 * dim)
        throw UserError(
          "Mesh/File: the boundary at " + place_of(mesh, face) +
          " is on no side of the bounding box within " + to_text(off) +
          " m (Mesh/Tolerance = " + to_text(mesh.tolerance) +
          "); a volume element has to be a box without holes or open seams. Make a hole "
          "a "
          "phase with a small modulus, let parts share their points; of a body of "
          "another "
          "shape homogenize a box of its material, and name points of the body in Volume "
          "element/Points of the localization (prm/examples/mesh/own_body)");
      sides[side].push_back(face);
    }
  return sides;
}

#define MESOSLIP_INSTANTIATE(dim)                                                   \
  template std::size_t n_faces_in_file(const Mesh<dim> &, const unsigned int);      \
  template std::string why_not_found(                                               \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const unsigned int); \
  template std::string place_of(const Mesh<dim> &, const BoundaryFace<dim> &);      \
  template double shortest_edge(const Mesh<dim> &, const BoundaryFace<dim> &);      \
  template std::array<std::vector<BoundaryFace<dim>>, 2UL * dim> faces_of_box(      \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
