#ifndef mesoslip_localization_strain_cell_set_h
#define mesoslip_localization_strain_cell_set_h

#include "exchange/body_snapshots.h"
#include "exchange/rve_file.h"
#include "grid/cell_block.h"
#include "mesh/cell_locator.h"
#include "mesh/cell_shapes.h"

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

namespace mesoslip
{
/** The cells of a volume or a body in the order of its file, x fastest: a grid, of which
 * nothing is stored but its numbers, or a whole mesh. */
template <int dim>
struct CellSet
{
  CellSet() = default;

  /** Those of @p file, an RveFile or BodySnapshots. */
  template <typename File>
  CellSet(const File &file, const bool of_grid)
    : is_grid(of_grid)
    , grid(file.grid)
    , mesh(of_grid ? Mesh<dim>() : file.mesh())
  {
  }

  /** Number of cells. */
  std::size_t n_cells() const
  {
    return is_grid ? grid.n_cells() : mesh.cells.size();
  }

  /** Number of their corners. */
  std::size_t n_points() const
  {
    return is_grid ? grid.n_nodes() : mesh.points.size();
  }

  /** Cells of a layer of a grid across its last axis; of a mesh one. */
  std::size_t cells_in_layer() const
  {
    return is_grid ? grid.cells_in_layer() : 1;
  }

  /** Middle and size of cell @p k. */
  CellMeasure<dim> measure(const std::size_t k) const;

  /** The box around all cells (m). */
  dealii::BoundingBox<dim> box() const;

  bool is_grid = true;   ///< whether mesh is empty
  UniformGrid<dim> grid; ///< of a mesh its box as one cell
  Mesh<dim> mesh;        ///< points and cells
};

/** The places along the axes of cell number @p k of a grid. */
template <int dim>
std::array<unsigned int, dim> places_of(const UniformGrid<dim> &grid, const std::size_t k)
{
  std::array<unsigned int, dim> places = {};
  std::size_t rest                     = k;
  for (unsigned int d = 0; d < dim; ++d)
    {
      places[d] = static_cast<unsigned int>(rest % grid.cells[d]);
      rest /= grid.cells[d];
    }
  return places;
}

/** The middle of a cell of a grid (m). */
template <int dim>
dealii::Point<dim> middle_of(const UniformGrid<dim> &grid,
                             const std::array<unsigned int, dim> &places)
{
  dealii::Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = grid.origin[d] + (places[d] + 0.5) * grid.spacing[d];
  return middle;
}

/** The places along the axes of the cell of a grid that holds @p point, as CellLocator finds
 * it: of several the upper one; up to a quarter of the diameter of a cell outside. */
template <int dim>
std::optional<std::array<unsigned int, dim>> cell_at(const UniformGrid<dim> &grid,
                                                     const dealii::Point<dim> &point);

/** "(0, 0.1) m" */
template <int dim>
std::string point_text(const dealii::Point<dim> &point);

/** "from (0, 0) m to (1, 1) m" */
template <int dim>
std::string corners_text(const dealii::BoundingBox<dim> &box);

/** "560 x 160" */
template <int dim>
std::string cells_text(const UniformGrid<dim> &grid);

/** Finds the cells that hold points; of a mesh it sorts them when it is asked first. */
template <int dim>
class CellFinder
{
public:
  /** The cells must outlive it. */
  explicit CellFinder(const CellSet<dim> &of_cells);

  /** Number of the cell that holds @p point; nothing if there is none. */
  std::optional<std::size_t> find(const dealii::Point<dim> &point);

private:
  const CellSet<dim> &cells;
  std::optional<CellLocator<dim>> locator; ///< finds cells of a mesh; none of a grid
};
} // namespace mesoslip

#endif
