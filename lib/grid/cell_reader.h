#ifndef mesoslip_grid_cell_reader_h
#define mesoslip_grid_cell_reader_h

#include "grid/cell_block.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace mesoslip
{
/**
 * Returns phases or materials of the cells of a block, x fastest, for example read from a
 * file. @throws UserError if they cannot be read
 */
using CellReader = std::function<std::vector<std::uint16_t>(const CellBlock<3> &)>;

/** Reader of @p id, the values of all cells of @p grid, x fastest. */
template <typename Index>
CellReader reader_of(const UniformGrid<3> &grid, const std::vector<Index> &id)
{
  return [whole = whole_block(grid), id](const CellBlock<3> &block) {
    std::vector<std::uint16_t> of_block;
    const auto &first = block.first;
    for (unsigned int k = first[2]; k < first[2] + block.cells[2]; ++k)
      for (unsigned int j = first[1]; j < first[1] + block.cells[1]; ++j)
        for (unsigned int i = first[0]; i < first[0] + block.cells[0]; ++i)
          of_block.push_back(id[whole.number_of({{i, j, k}})]);
    return of_block;
  };
}
} // namespace mesoslip

#endif
