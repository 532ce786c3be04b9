#include "mesh/boundary/open_seams.h"

#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace mesoslip
{
namespace
{
template <int dim>
double distance_to_line(const dealii::Point<dim> &p,
                        const dealii::Point<dim> &a,
                        const dealii::Point<dim> &b)
{
  const dealii::Tensor<1, dim> along = b - a;
  const double t = std::clamp((p - a) * along / along.norm_square(), 0., 1.);
  return p.distance(a + t * along);
}

double distance_to_triangle(const dealii::Point<3> &p,
                            const std::array<dealii::Point<3>, 3> &corners)
{
  const dealii::Tensor<1, 3> normal =
    cross_product_3d(corners[1] - corners[0], corners[2] - corners[0]);
  bool is_over = true;
  double least = std::numeric_limits<double>::infinity();
  for (unsigned int v = 0; v < 3; ++v)
    {
      const dealii::Point<3> &a = corners[v], &b = corners[(v + 1) % 3];
      is_over = is_over && cross_product_3d(b - a, p - a) * normal >= 0.;
      least   = std::min(least, distance_to_line(p, a, b));
    }
  return is_over ? std::fabs((p - corners[0]) * normal) / normal.norm() : least;
}

/** A quadrilateral is treated as two triangles. */
template <int dim>
double distance_to_face(const Mesh<dim> &mesh,
                        const dealii::Point<dim> &p,
                        const BoundaryFace<dim> &face)
{
  const auto corner = [&](const unsigned int v) -> const dealii::Point<dim> & {
    return mesh.points[face.points[v]];
  };
  if constexpr (dim == 2)
    return distance_to_line(p, corner(0), corner(1));
  else
    {
      const double first = distance_to_triangle(p, {{corner(0), corner(1), corner(2)}});
      return face.n_points == 3
               ? first
               : std::min(first,
                          distance_to_triangle(p, {{corner(1), corner(3), corner(2)}}));
    }
}
} // namespace

template <int dim>
std::vector<unsigned int> open_seams(const Mesh<dim> &mesh,
                                     const std::vector<BoundaryFace<dim>> &faces)
{
  constexpr double near = 0.01;
  std::map<unsigned int, double> reach; // tolerance per point (m)
  std::vector<double> reach_of_face;
  std::vector<dealii::BoundingBox<dim>> boxes;
  for (const BoundaryFace<dim> &face : faces)
    {
      std::vector<dealii::Point<dim>> corners;
      reach_of_face.push_back(near * shortest_edge(mesh, face));
      for (unsigned int v = 0; v < face.n_points; ++v)
        {
          corners.push_back(mesh.points[face.points[v]]);
          double &of_point =
            reach.emplace(face.points[v], reach_of_face.back()).first->second;
          of_point = std::min(of_point, reach_of_face.back());
        }
      boxes.emplace_back(corners);
      boxes.back().extend(reach_of_face.back());
    }
  const auto tree = dealii::pack_rtree_of_indices(boxes);
  std::vector<unsigned int> result, found;
  for (const auto &[p, of_point] : reach)
    {
      found.clear();
      tree.query(boost::geometry::index::intersects(mesh.points[p]),
                 std::back_inserter(found));
      const double r = of_point;
      if (std::any_of(found.begin(), found.end(), [&, p = p](const unsigned int f) {
            const auto end = faces[f].points.begin() + faces[f].n_points;
            return std::find(faces[f].points.begin(), end, p) == end &&
                   distance_to_face(mesh, mesh.points[p], faces[f]) <=
                     std::min(r, reach_of_face[f]);
          }))
        result.push_back(p);
    }
  return result;
}

template std::vector<unsigned int> open_seams(const Mesh<2> &,
                                              const std::vector<BoundaryFace<2>> &);
template std::vector<unsigned int> open_seams(const Mesh<3> &,
                                              const std::vector<BoundaryFace<3>> &);
} // namespace mesoslip
