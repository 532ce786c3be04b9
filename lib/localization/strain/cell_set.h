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
/** The cells of a volume or a body in the order of its file, x fastest: a grid, stored as
 * its numbers only, or a whole mesh. */
template <int dim>
struct CellSet
{
  CellSet() = default;

  /** The cells of @p file, an RveFile or BodySnapshots. */
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

  /** Number of grid nodes or mesh points. */
  std::size_t n_points() const
  {
    return is_grid ? grid.n_nodes() : mesh.points.size();
  }

  /** Cells per layer of a grid across its last axis; for a mesh 1. */
  std::size_t cells_in_layer() const
  {
    return is_grid ? grid.cells_in_layer() : 1;
  }

  /** Centroid and size of cell @p k. */
  CellMeasure<dim> measure(const std::size_t k) const;

  /** The box around all cells (m). */
  dealii::BoundingBox<dim> box() const;

  bool is_grid = true;   ///< whether mesh is empty
  UniformGrid<dim> grid; ///< for a mesh its bounding box as one cell
  Mesh<dim> mesh;        ///< points and cells
};

/** Indices along the axes of cell number @p k of a grid. */
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

/** Indices of the grid cell that holds @p point, as in CellLocator: of several cells the
 * upper one; the point may lie up to a quarter of the diameter of a cell outside. */
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

/** Finds the cells that hold points; on a mesh the search tree is built at the first
 * query. */
template <int dim>
class CellFinder
{
public:
  /** The cells must outlive this object. */
  explicit CellFinder(const CellSet<dim> &of_cells);

  /** Number of the cell that holds @p point; empty if there is none. */
  std::optional<std::size_t> find(const dealii::Point<dim> &point);

private:
  const CellSet<dim> &cells;
  std::optional<CellLocator<dim>> locator; ///< search tree of a mesh; empty for a grid
};
} // namespace mesoslip

#endif
