#include "localization/strain/cell_set.h"

#include "parameters/parameters.h"

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
  constexpr double reach = 0.25, on_face = 1e-9; // in cell diameters, as in CellLocator
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
std::string point_text(const dealii::Point<dim> &point)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d == 0 ? "(" : ", ") + to_text(point[d]);
  return text + ") m";
}

template <int dim>
std::string corners_text(const dealii::BoundingBox<dim> &box)
{
  return "from " + point_text(box.get_boundary_points().first) + " to " +
         point_text(box.get_boundary_points().second);
}

template <int dim>
std::string cells_text(const UniformGrid<dim> &grid)
{
  std::string text;
  for (unsigned int d = 0; d < dim; ++d)
    text += (d == 0 ? "" : " x ") + std::to_string(grid.cells[d]);
  return text;
}

template <int dim>
CellFinder<dim>::CellFinder(const CellSet<dim> &of_cells)
  : cells(of_cells)
{
}

template <int dim>
std::optional<std::size_t> CellFinder<dim>::find(const dealii::Point<dim> &point)
{
  if (cells.is_grid)
    {
      const auto at = cell_at(cells.grid, point);
      if (!at)
        return std::nullopt;
      return CellBlock<dim>{{}, cells.grid.cells}.number_of(*at);
    }
  if (!locator)
    locator.emplace(cells.mesh);
  const auto cell = locator->find(point);
  return cell ? std::optional<std::size_t>(*cell) : std::nullopt;
}

#define MESOSLIP_INSTANTIATE(dim)                                      \
  template struct CellSet<dim>;                                        \
  template class CellFinder<dim>;                                      \
  template std::optional<std::array<unsigned int, dim>> cell_at<dim>(  \
    const UniformGrid<dim> &, const dealii::Point<dim> &);             \
  template std::string point_text(const dealii::Point<dim> &);         \
  template std::string corners_text(const dealii::BoundingBox<dim> &); \
  template std::string cells_text(const UniformGrid<dim> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
