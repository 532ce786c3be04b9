#ifndef mesoslip_mesh_triangulation_cells_h
#define mesoslip_mesh_triangulation_cells_h

#include "mesh/mesh.h"

#include <deal.II/grid/tria_description.h>

#include <algorithm>

namespace mesoslip
{
/** Converts @p cells for deal.II's triangulations and grid tools. */
template <int dim>
std::vector<dealii::CellData<dim>> to_dealii(const std::vector<Cell> &cells)
{
  std::vector<dealii::CellData<dim>> result;
  result.reserve(cells.size());
  for (const Cell &cell : cells)
    {
      result.emplace_back(cell.vertices.size());
      std::copy(cell.vertices.begin(), cell.vertices.end(),
                result.back().vertices.begin());
      result.back().material_id = cell.material_id;
    }
  return result;
}

/** Converts cells of deal.II. */
template <int dim>
std::vector<Cell> from_dealii(const std::vector<dealii::CellData<dim>> &cells)
{
  std::vector<Cell> result(cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k)
    {
      result[k].vertices.assign(cells[k].vertices.begin(), cells[k].vertices.end());
      result[k].material_id = cells[k].material_id;
    }
  return result;
}
} // namespace mesoslip

#endif
