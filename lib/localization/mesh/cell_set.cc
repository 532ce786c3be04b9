#include "localization/mesh/cell_set.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
template <int dim>
CellMeasure<dim> CellSet<dim>::measure(const std::size_t k) const
{
  if (is_grid)
    return {middle_of<dim>(grid, places_of(grid, k)), grid.cell_measure()};
  return cell_measure(mesh, mesh.cells[k].vertices);
}

template <int dim>
dealii::BoundingBox<dim> CellSet<dim>::box() const
{
  if (!is_grid)
    return dealii::BoundingBox<dim>(mesh.points);
  std::pair<dealii::Point<dim>, dealii::Point<dim>> corners;
  for (unsigned int d = 0; d < dim; ++d)
    {
      corners.first[d]  = grid.origin[d];
      corners.second[d] = grid.origin[d] + grid.extent(d);
    }
  return dealii::BoundingBox<dim>(corners);
}

template <int dim>
std::optional<std::array<unsigned int, dim>> cell_at(const UniformGrid<dim> &grid,
                                                     const dealii::Point<dim> &point)
{
  constexpr double reach = 0.25, on_face = 1e-9; // in diameters, as CellLocator
  double squares = 0.;
  for (const double h : grid.spacing)
    squares += h * h;
  const double diameter              = std::sqrt(squares);
  std::array<unsigned int, dim> cell = {};
  for (unsigned int d = 0; d < dim; ++d)
    {
      const double x = point[d] - grid.origin[d];
      if (!(x >= -reach * diameter && x <= grid.extent(d) + reach * diameter))
        return std::nullopt;
      cell[d] = std::min(static_cast<unsigned int>(
                           std::max(0., (x + on_face * diameter) / grid.spacing[d])),
                         grid.cells[d] - 1);
    }
  return cell;
}

template <int dim>
CellFinder<dim>::CellFinder(const CellSet<dim> &of_cells)
  : cells(of_cells)
{
  if (!cells.is_grid)
    locator.emplace(cells.mesh);
}

template <int dim>
std::optional<std::size_t> CellFinder<dim>::find(const dealii::Point<dim> &point) const
{
  if (locator)
    {
      const auto cell = locator->find(point);
      return cell ? std::optional<std::size_t>(*cell) : std::nullopt;
    }
  const auto at = cell_at(cells.grid, point);
  if (!at)
    return std::nullopt;
  return CellBlock<dim>{{}, cells.grid.cells}.number_of(*at);
}

template struct CellSet<2>;
template struct CellSet<3>;
template class CellFinder<2>;
template class CellFinder<3>;
template std::optional<std::array<unsigned int, 2>> cell_at<2>(const UniformGrid<2> &,
                                                               const dealii::Point<2> &);
template std::optional<std::array<unsigned int, 3>> cell_at<3>(const UniformGrid<3> &,
                                                               const dealii::Point<3> &);
} // namespace mesoslip
