#ifndef mesoslip_grid_cell_block_h
#define mesoslip_grid_cell_block_h

#include "grid/uniform_grid.h"

#include <algorithm>

namespace mesoslip
{
/**
 * A block of the cells of a grid; cells and nodes of the block have their own numbering,
 * x fastest.
 */
template <int dim>
struct CellBlock
{
  std::array<unsigned int, dim> first = {}; ///< lowest cell along each axis
  std::array<unsigned int, dim> cells = {}; ///< numbers along the axes, or zeros

  /** Product of the numbers along the axes. */
  std::size_t n_cells() const
  {
    std::size_t n = 1;
    for (const unsigned int c : cells)
      n *= c;
    return n;
  }

  /** Number in the block of the cell with indices @p at in the whole grid. */
  std::size_t number_of(const std::array<unsigned int, dim> &at) const
  {
    std::size_t number = 0;
    for (unsigned int d = dim; d-- > 0;)
      number = number * cells[d] + (at[d] - first[d]);
    return number;
  }
};

/**
 * The cells from @p lower to @p upper, both included, and @p n_layers around them,
 * clipped to the grid.
 */
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

/** All cells of @p grid. */
template <int dim>
CellBlock<dim> whole_block(const UniformGrid<dim> &grid)
{
  return {{}, grid.cells};
}

/**
 * Calls @p treat (first, count) for pieces of @p n cells; each piece has whole layers of
 * @p in_layer cells and needs little memory.
 */
template <typename Treat>
void for_each_piece(const std::size_t n, const std::size_t in_layer, const Treat &treat)
{
  constexpr std::size_t few = 1 << 14;
  const std::size_t piece   = std::max<std::size_t>(few / in_layer, 1) * in_layer;
  for (std::size_t first = 0; first < n; first += piece)
    treat(first, std::min(piece, n - first));
}

/**
 * Calls @p treat for small pieces of the non-empty @p block in ascending order; a piece
 * is a block of whole layers across the last axis.
 */
template <int dim, typename Treat>
void for_each_piece(const CellBlock<dim> &block, const Treat &treat)
{
  const std::size_t in_layer = block.n_cells() / block.cells[dim - 1];
  CellBlock<dim> piece       = block;
  for_each_piece(block.n_cells(), in_layer,
                 [&](const std::size_t first, const std::size_t count) {
                   piece.first[dim - 1] =
                     block.first[dim - 1] + static_cast<unsigned int>(first / in_layer);
                   piece.cells[dim - 1] = static_cast<unsigned int>(count / in_layer);
                   treat(piece);
                 });
}
} // namespace mesoslip

#endif
