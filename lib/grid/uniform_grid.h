#ifndef mesoslip_grid_uniform_grid_h
#define mesoslip_grid_uniform_grid_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A box of equal cells. Cells and nodes are numbered with x fastest; in 2D a row has all
 * cells (or nodes) of equal y. Lengths in metres.
 */
template <int dim>
struct UniformGrid
{
  std::array<unsigned int, dim> cells = {}; ///< numbers along the axes
  std::array<double, dim> spacing     = {}; ///< edges of a cell (m)
  std::array<double, dim> origin      = {}; ///< lower left corner (m)

  /** Product of the numbers along the axes. */
  std::size_t n_cells() const
  {
    std::size_t n = 1;
    for (const unsigned int c : cells)
      n *= c;
    return n;
  }

  /** Cells in a layer across the last axis: a row of a plane grid, a plane of a box. */
  std::size_t cells_in_layer() const
  {
    return n_cells() / cells[dim - 1];
  }

  /** Product of the numbers of cells plus one along the axes. */
  std::size_t n_nodes() const
  {
    std::size_t n = 1;
    for (const unsigned int c : cells)
      n *= c + 1;
    return n;
  }

  /** Length of the box along one direction (m). */
  double extent(const unsigned int direction) const
  {
    return cells[direction] * spacing[direction];
  }

  /** Area (2D) or volume of one cell. */
  double cell_measure() const
  {
    double measure = 1.;
    for (const double h : spacing)
      measure *= h;
    return measure;
  }

  /**
   * Nodes at the corners of cell @p number; bit d of a corner is set at the upper end of
   * axis d.
   */
  std::array<unsigned int, 1U << dim> corners(const unsigned int number) const
  {
    std::array<unsigned int, 1U << dim> nodes = {};
    unsigned int rest = number, stride = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        for (unsigned int v = 0; v < nodes.size(); ++v)
          nodes[v] += (rest % cells[d] + (v >> d & 1U)) * stride;
        rest /= cells[d];
        stride *= cells[d] + 1;
      }
    return nodes;
  }

  /** Coordinates of node @p number (m). */
  std::array<double, dim> node(const unsigned int number) const
  {
    std::array<double, dim> place = {};
    unsigned int rest             = number;
    for (unsigned int d = 0; d < dim; ++d)
      {
        place[d] = origin[d] + rest % (cells[d] + 1) * spacing[d];
        rest /= cells[d] + 1;
      }
    return place;
  }

  /** Whether numbers, spacing and origin are equal, bit by bit. */
  bool operator==(const UniformGrid &other) const
  {
    return cells == other.cells && spacing == other.spacing && origin == other.origin;
  }
};

/**
 * Phase index of each cell of a uniform grid, x fastest; `id.size() == grid.n_cells()`.
 */
template <int dim>
struct PhaseMap
{
  UniformGrid<dim> grid;        ///< the cells
  std::vector<std::uint8_t> id; ///< phase of each cell, x fastest
};

/** "560 x 160": two numbers of cells or pixels. */
std::string numbers_text(const unsigned int width, const unsigned int height);

/** "0.1 x 0.2 mm": two lengths (m) with the unit that suits the larger one. */
std::string lengths_text(const double width, const double height);

/** "560 x 160 cells of 0.1 x 0.1 mm, 56 x 16 mm"; lengths in km, m, mm or um. */
std::string size_text(const UniformGrid<2> &grid);
} // namespace mesoslip

#endif
