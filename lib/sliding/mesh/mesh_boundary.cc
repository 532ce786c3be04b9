#include "sliding/mesh/sliding_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <unordered_map>

namespace mesoslip
{
template <int dim>
MeshBoundary mesh_boundary(const Mesh<dim> &mesh,
                           const std::vector<BoundaryFace<dim>> &faces)
{
  const BoundaryPoints<dim> found = boundary_points(mesh, faces);
  std::map<unsigned int, double> area; // by periodic master
  for (std::size_t k = 0; k < found.points.size(); ++k)
    area[mesh.master(found.points[k])] += found.normal_area[k][dim - 1];
  MeshBoundary boundary;
  for (const auto &[point, of_point] : area)
    boundary.points.push_back(point);
  const auto coordinates = [&](const unsigned int point) {
    std::array<double, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = mesh.points[point][d];
    return result;
  };
  std::sort(boundary.points.begin(), boundary.points.end(),
            [&](const unsigned int a, const unsigned int b) {
              return coordinates(a) < coordinates(b);
            });
  double lowest = std::numeric_limits<double>::infinity();
  for (const unsigned int point : boundary.points)
    {
      boundary.area.push_back(area.at(point));
      boundary.height.push_back(mesh.points[point][dim - 1]);
      for (unsigned int d = 0; d + 1 < dim; ++d)
        boundary.position[d].push_back(mesh.points[point][d]);
      lowest = std::min(lowest, boundary.height.back());
    }
  for (double &h : boundary.height)
    h -= lowest;
  return boundary;
}

template <int dim>
std::vector<double> mean_of_phases(const Mesh<dim> &mesh,
                                   const std::vector<BoundaryFace<dim>> &faces,
                                   const MeshBoundary &boundary,
                                   const std::vector<double> &property,
                                   const std::vector<double> &weight)
{
  // Faces that stand on the flat have a tiny weight, so they matter only if there are no
  // other faces.
  constexpr double standing = 1e-9;
  std::unordered_map<unsigned int, std::array<double, 2>> sums;
  for (const BoundaryFace<dim> &face : faces)
    {
      const unsigned int phase          = mesh.cells[face.cell].material_id;
      const BoundaryPoints<dim> of_face = boundary_points<dim>(mesh, {face});
      for (std::size_t k = 0; k < of_face.points.size(); ++k)
        {
          const dealii::Tensor<1, dim> &area = of_face.normal_area[k];
          const double share =
            weight[phase] * (std::fabs(area[dim - 1]) + standing * area.norm());
          auto &sum = sums[mesh.master(of_face.points[k])];
          sum[0] += share * property[phase];
          sum[1] += share;
        }
    }
  std::vector<double> means;
  for (const unsigned int point : boundary.points)
    means.push_back(sums.at(point)[0] / sums.at(point)[1]);
  return means;
}

template <int dim>
std::vector<SurfaceFacet> facets_of(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &faces,
                                    const MeshBoundary &boundary)
{
  constexpr double standing = 1e-9;
  std::unordered_map<unsigned int, unsigned int> number;
  for (unsigned int k = 0; k < boundary.points.size(); ++k)
    number.emplace(boundary.points[k], k);
  std::vector<SurfaceFacet> facets;
  for (const BoundaryFace<dim> &face : faces)
    {
      SurfaceFacet facet;
      facet.n = face.n_points;
      for (unsigned int v = 0; v < face.n_points; ++v)
        {
          const unsigned int at    = face.n_points == 4 && v > 1 ? 5 - v : v,
                             point = face.points[v];
          facet.node[at]           = number.at(mesh.master(point));
          for (unsigned int d = 0; d + 1 < dim; ++d)
            facet.place[at][d] = mesh.points[point][d];
        }
      if (facet.size() > standing * std::pow(shortest_edge(mesh, face), dim - 1))
        facets.push_back(facet);
    }
  return facets;
}

template <int dim>
std::vector<double> extreme_of_phases(const Mesh<dim> &mesh,
                                      const std::vector<BoundaryFace<dim>> &faces,
                                      const MeshBoundary &boundary,
                                      const std::vector<double> &property,
                                      const bool largest)
{
  std::unordered_map<unsigned int, double> found;
  for (const BoundaryFace<dim> &face : faces)
    {
      const double here = property[mesh.cells[face.cell].material_id];
      for (const unsigned int point : boundary_points<dim>(mesh, {face}).points)
        {
          double &extreme = found.emplace(mesh.master(point), here).first->second;
          extreme         = largest ? std::max(extreme, here) : std::min(extreme, here);
        }
    }
  std::vector<double> extremes;
  for (const unsigned int point : boundary.points)
    extremes.push_back(found.at(point));
  return extremes;
}

#define MESOSLIP_INSTANTIATE(dim)                                                     \
  template MeshBoundary mesh_boundary(const Mesh<dim> &,                              \
                                      const std::vector<BoundaryFace<dim>> &);        \
  template std::vector<double> mean_of_phases(                                        \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const MeshBoundary &,  \
    const std::vector<double> &, const std::vector<double> &);                        \
  template std::vector<SurfaceFacet> facets_of(                                       \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const MeshBoundary &); \
  template std::vector<double> extreme_of_phases(                                     \
    const Mesh<dim> &, const std::vector<BoundaryFace<dim>> &, const MeshBoundary &,  \
    const std::vector<double> &, const bool);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
