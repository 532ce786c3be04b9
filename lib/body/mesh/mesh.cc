#include "body/mesh/mesh.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace mesoslip
{
Mesh<2> mesh_of_grid(const UniformMaterial &material)
{
  const UniformGrid<2> &grid = material.grid();
  Mesh<2> mesh;
  mesh.phases      = material.phases();
  mesh.periodicity = material.periodicity();
  mesh.n_columns   = material.n_columns();
  for (unsigned int j = 0; j < material.n_rows(); ++j)
    for (unsigned int i = 0; i < material.n_columns(); ++i)
      mesh.points.push_back({{i * grid.spacing[0], j * grid.spacing[1]}});
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const unsigned int lower = j * mesh.n_columns + i, upper = lower + mesh.n_columns;
        mesh.cells.insert(mesh.cells.end(), {lower, lower + 1, upper, upper + 1});
        mesh.phase.push_back(material.phase_of(i, j));
      }
  return mesh;
}

Mesh<2> cut_into_triangles(const Mesh<2> &mesh)
{
  Mesh<2> result   = mesh;
  result.n_corners = 3;
  result.cells.clear();
  result.phase.clear();
  for (std::size_t k = 0; k < mesh.n_cells(); ++k)
    {
      const unsigned int *p = &mesh.cells[4 * k];
      if (k % 2 == 0)
        result.cells.insert(result.cells.end(), {p[0], p[1], p[3], p[0], p[3], p[2]});
      else
        result.cells.insert(result.cells.end(), {p[0], p[1], p[2], p[1], p[3], p[2]});
      result.phase.insert(result.phase.end(), 2, mesh.phase[k]);
    }
  return result;
}

std::vector<unsigned int> points_of_side(const Mesh<2> &mesh, const unsigned int side)
{
  const unsigned int axis    = side / 2;
  const auto [first, second] = std::minmax_element(
    mesh.points.begin(), mesh.points.end(),
    [axis](const auto &a, const auto &b) { return a[axis] < b[axis]; });
  const double lower = (*first)[axis], upper = (*second)[axis],
               place = side % 2 == 0 ? lower : upper;
  std::vector<unsigned int> points;
  for (unsigned int k = 0; k < mesh.points.size(); ++k)
    if (std::fabs(mesh.points[k][axis] - place) <= 1e-9 * (upper - lower))
      points.push_back(k);
  std::sort(points.begin(), points.end(),
            [&](const unsigned int a, const unsigned int b) {
              return mesh.points[a][1 - axis] < mesh.points[b][1 - axis];
            });
  return points;
}

std::vector<std::array<unsigned int, 2>> opposite_points(const Mesh<2> &mesh,
                                                         const unsigned int axis)
{
  const std::vector<unsigned int> lower = points_of_side(mesh, 2 * axis),
                                  upper = points_of_side(mesh, 2 * axis + 1);
  const std::string sides = std::string("the sides at both ends of ") + "xy"[axis];
  if (lower.size() != upper.size())
    throw std::invalid_argument(sides + " have " + std::to_string(lower.size()) +
                                " and " + std::to_string(upper.size()) +
                                " nodes; a periodic mesh needs equal ones");
  const auto along = [&](const unsigned int k) { return mesh.points[k][1 - axis]; };
  std::vector<std::array<unsigned int, 2>> pairs;
  for (std::size_t k = 0; k < lower.size(); ++k)
    {
      const std::size_t next = k + 1 < lower.size() ? k + 1 : k - 1;
      const double distance  = std::fabs(along(upper[k]) - along(lower[k]));
      if (!(distance <= 1e-6 * std::fabs(along(lower[next]) - along(lower[k]))))
        throw std::invalid_argument(sides + " have nodes that are not opposite: " +
                                    std::to_string(distance * 1e3) + " mm apart");
      pairs.push_back({{upper[k], lower[k]}});
    }
  return pairs;
}
} // namespace mesoslip
