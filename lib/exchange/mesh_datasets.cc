#include "exchange/mesh_datasets.h"

#include "base/errors.h"
#include "exchange/datasets.h"

#include <algorithm>
#include <array>

namespace mesoslip
{
namespace
{
constexpr unsigned int kinds[2][2] = {{4, 5}, {6, 9}}; ///< simplex, hypercube

/** Number of corners of a cell of @p kind; 0 for unknown kinds. */
template <int dim>
unsigned int n_corners(const unsigned int kind)
{
  return kind == kinds[dim - 2][0] ? dim + 1 : kind == kinds[dim - 2][1] ? 1U << dim : 0;
}

/** Converts corners between the order of deal.II and the order around faces. */
template <int dim>
void turn_faces(unsigned int *corners, const std::size_t n)
{
  for (std::size_t face = 2; n != dim + 1 && face < n; face += 4)
    std::swap(corners[face], corners[face + 1]);
}

template <int dim>
std::vector<Cell> cells_of(const std::vector<unsigned int> &topology,
                           const std::size_t n_points,
                           const std::string &broken)
{
  std::vector<Cell> cells;
  for (std::size_t at = 0; at < topology.size();)
    {
      const unsigned int n = n_corners<dim>(topology[at++]);
      if (n == 0 || at + n > topology.size())
        throw UserError(broken);
      auto &corners = cells.emplace_back(n).vertices;
      for (unsigned int &corner : corners)
        if ((corner = topology[at++]) >= n_points)
          throw UserError(broken);
      turn_faces<dim>(corners.data(), n);
    }
  return cells;
}
} // namespace

template <int dim>
std::size_t topology_size(const Mesh<dim> &mesh)
{
  std::size_t n = 0;
  for (const auto &cell : mesh.cells)
    n += 1 + cell.vertices.size();
  return n;
}

template <int dim>
void write_mesh(Hdf5File &file, const Mesh<dim> &mesh)
{
  std::vector<double> points;
  for (const auto &point : mesh.points)
    for (unsigned int d = 0; d < dim; ++d)
      points.push_back(point[d]);
  write_dataset(file, "/mesh/points", {mesh.points.size(), dim}, points, "m");

  std::vector<unsigned int> topology;
  topology.reserve(topology_size(mesh));
  for (const auto &cell : mesh.cells)
    {
      const auto &v = cell.vertices;
      topology.push_back(kinds[dim - 2][v.size() == dim + 1 ? 0 : 1]);
      topology.insert(topology.end(), v.begin(), v.end());
      turn_faces<dim>(&topology[topology.size() - v.size()], v.size());
    }
  write_dataset(file, "/mesh/topology", {topology.size()}, topology);
}

template <int dim>
Mesh<dim> read_mesh_cells(const Hdf5File &file, const std::string &program)
{
  const auto points =
    file.read<double>("/mesh/points", {any_extent, dim}, program + " writes it");
  file.require_unit("/mesh/points", "m");
  Mesh<dim> mesh;
  for (std::size_t k = 0; k < points.size(); k += dim)
    {
      auto &point = mesh.points.emplace_back();
      for (unsigned int d = 0; d < dim; ++d)
        point[d] = points[k + d];
    }
  mesh.cells = cells_of<dim>(
    file.read<unsigned int>("/mesh/topology", {any_extent}, program + " writes it"),
    mesh.points.size(),
    file.path() + ": /mesh/topology is no list of cells and their corners; run " +
      program + " again");
  return mesh;
}

template <int dim>
Mesh<dim> mesh_of_cells(const UniformGrid<dim> &grid)
{
  Mesh<dim> mesh;
  mesh.points.resize(grid.n_nodes());
  for (unsigned int p = 0; p < mesh.points.size(); ++p)
    for (unsigned int d = 0; d < dim; ++d)
      mesh.points[p][d] = grid.node(p)[d];
  mesh.cells.reserve(grid.n_cells());
  for (unsigned int k = 0; k < grid.n_cells(); ++k)
    {
      const auto corners = grid.corners(k);
      mesh.cells.emplace_back(1U << dim).vertices.assign(corners.begin(), corners.end());
    }
  return mesh;
}

template Mesh<2> mesh_of_cells(const UniformGrid<2> &);
template Mesh<3> mesh_of_cells(const UniformGrid<3> &);
template std::size_t topology_size(const Mesh<2> &);
template std::size_t topology_size(const Mesh<3> &);
template void write_mesh(Hdf5File &, const Mesh<2> &);
template void write_mesh(Hdf5File &, const Mesh<3> &);
template Mesh<2> read_mesh_cells(const Hdf5File &, const std::string &);
template Mesh<3> read_mesh_cells(const Hdf5File &, const std::string &);
} // namespace mesoslip
