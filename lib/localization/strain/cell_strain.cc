#include "localization/strain/cell_strain.h"

#include "localization/strain/slope_fits.h"
#include "mesh/cell_shapes.h"

#include <map>

namespace mesoslip
{
template <int dim>
CellStrain<dim>::CellStrain(const Mesh<dim> &mesh,
                            const std::vector<unsigned int> &wanted,
                            const bool only_means)
{
  const std::vector<unsigned int> cells =
    only_means ? wanted : add_neighbours(mesh, wanted);
  add_corners(mesh, cells);
  mean.resize(cells.size());
}

template <int dim>
std::vector<unsigned int>
CellStrain<dim>::add_neighbours(const Mesh<dim> &mesh,
                                const std::vector<unsigned int> &wanted)
{
  const SlopeFits<dim> fits(mesh);
  std::vector<unsigned int> cells = wanted;
  std::map<unsigned int, std::size_t> number;
  for (std::size_t k = 0; k < wanted.size(); ++k)
    number.emplace(wanted[k], k);
  for (const unsigned int cell : wanted)
    {
      centroid.push_back(cell_measure(mesh, mesh.cells[cell].vertices).centroid);
      first_neighbour.push_back(neighbours.size());
      for (const SlopeWeight<dim> &other : fits.of(cell))
        {
          const auto [entry, is_new] = number.emplace(other.cell, cells.size());
          if (is_new)
            cells.push_back(other.cell);
          neighbours.push_back({entry->second, other.weight});
        }
    }
  first_neighbour.push_back(neighbours.size());
  slope.resize(wanted.size());
  return cells;
}

template <int dim>
void CellStrain<dim>::add_corners(const Mesh<dim> &mesh,
                                  const std::vector<unsigned int> &cells)
{
  std::size_t n_corners = 0;
  for (const unsigned int cell : cells)
    n_corners += mesh.cells[cell].vertices.size();
  corners.reserve(n_corners);
  first_corner.reserve(cells.size() + 1);
  for (const unsigned int cell : cells)
    {
      const auto &vertices  = mesh.cells[cell].vertices;
      const auto integrated = integrated_gradients(mesh, vertices);
      const double volume   = cell_measure(mesh, vertices).volume;
      first_corner.push_back(corners.size());
      for (std::size_t v = 0; v < vertices.size(); ++v)
        corners.push_back({vertices[v], integrated[v] / volume});
    }
  first_corner.push_back(corners.size());
}

template <int dim>
void CellStrain<dim>::set_displacement(const std::vector<double> &u)
{
  for (std::size_t cell = 0; cell < mean.size(); ++cell)
    {
      VoigtVector<dim> strain = VoigtVector<dim>::Zero();
      for (std::size_t k = first_corner[cell]; k < first_corner[cell + 1]; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            strain(voigt_index<dim>(c, d)) +=
              corners[k].gradient[d] * u[corners[k].point * dim + c];
      mean[cell] = strain;
    }
  for (std::size_t cell = 0; cell < slope.size(); ++cell)
    {
      auto &of_cell = slope[cell];
      of_cell.fill(VoigtVector<dim>::Zero());
      for (std::size_t k = first_neighbour[cell]; k < first_neighbour[cell + 1]; ++k)
        for (unsigned int d = 0; d < dim; ++d)
          of_cell[d] += neighbours[k].weight[d] * (mean[neighbours[k].cell] - mean[cell]);
    }
}

template <int dim>
MeanStrain<dim>::MeanStrain(const Mesh<dim> &mesh)
  : gradient(mesh.points.size())
{
  double volume = 0.;
  for (const auto &cell : mesh.cells)
    {
      volume += cell_measure(mesh, cell.vertices).volume;
      const auto integrated = integrated_gradients(mesh, cell.vertices);
      for (std::size_t v = 0; v < cell.vertices.size(); ++v)
        gradient[cell.vertices[v]] += integrated[v];
    }
  for (auto &of_point : gradient)
    of_point /= volume;
}

template <int dim>
MeanStrain<dim> MeanStrain<dim>::part(const std::size_t first, const std::size_t n) const
{
  const auto begin = gradient.begin() + static_cast<std::ptrdiff_t>(first);
  MeanStrain some;
  some.gradient.assign(begin, begin + static_cast<std::ptrdiff_t>(n));
  return some;
}

template <int dim>
void MeanStrain<dim>::add(const std::vector<double> &u, VoigtVector<dim> &strain) const
{
  for (std::size_t k = 0; k < gradient.size(); ++k)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        strain(voigt_index<dim>(c, d)) += gradient[k][d] * u[k * dim + c];
}

template class CellStrain<2>;
template class CellStrain<3>;
template class MeanStrain<2>;
template class MeanStrain<3>;
} // namespace mesoslip
