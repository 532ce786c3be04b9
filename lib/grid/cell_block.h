#ifndef mesoslip_grid_cell_block_h
#define mesoslip_grid_cell_block_h

#include "grid/uniform_grid.h"

#include <algorithm>

namespace mesoslip
{
/** A block of the cells of a grid; its cells and nodes are numbered by themselves, x
 * fastest. */
template <int dim>
struct CellBlock
{
  std::array<unsigned int, dim> first = {}; ///< the lowest cell along each axis
  std::array<unsigned int, dim> cells = {}; ///< numbers along the axes; zeros: no cells

  /** Product of the numbers along the axes. */
  std::size_t n_cells() const
  {
    std::size_t n = 1;
    for (const unsigned int c : cells)
      n *= c;
    return n;
  }

  /** Number in the block of the cell that is @p at along each axis of the whole grid. */
  std::size_t number_of(const std::array<unsigned int, dim> &at) const
  {
    std::size_t number = 0;
    for (unsigned int d = dim; d-- > 0;)
      number = number * cells[d] + (at[d] - first[d]);
    return number;
  }
};

/** The cells from @p lower to @p upper, both included, with @p n_layers around them as far as
 * the grid reaches. */
template <int dim>
CellBlock<dim> block_around(const UniformGrid<dim> &grid,
                            const std::array<unsigned int, dim> &lower,
                            const std::array<unsigned int, dim> &upper,
                            const unsigned int n_layers)
{
  CellBlock<dim> block;
  for (unsigned int d = 0; d < dim; ++d)
    {
      block.first[d] = lower[d] > n_layers ? lower[d] - n_layers : 0;
      block.cells[d] = std::min(upper[d] + n_layers + 1, grid.cells[d]) - block.first[d];
    }
  return block;
}
} // namespace mesoslip

#endif
