#ifndef mesoslip_morphology_cell_box_h
#define mesoslip_morphology_cell_box_h

#include "grid/uniform_grid.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** Half-open ranges of cells [x_begin, x_end) x [y_begin, y_end). */
struct CellBox
{
  unsigned int x_begin; ///< first column
  unsigned int x_end;   ///< one beyond the last column
  unsigned int y_begin; ///< first row
  unsigned int y_end;   ///< one beyond the last row

  /** No cell at all. */
  bool empty() const
  {
    return x_begin >= x_end || y_begin >= y_end;
  }

  /** Width times height. */
  std::size_t n_cells() const
  {
    return empty() ? 0 : std::size_t(x_end - x_begin) * (y_end - y_begin);
  }
};

/** All cells of phase @p background. */
PhaseMap<2> homogeneous_map(const UniformGrid<2> &grid,
                            const std::uint8_t background = 0);

/** Gives all cells of a box, which lies inside the grid, to @p phase. */
void fill_box(PhaseMap<2> &map, const CellBox &box, const std::uint8_t phase);

/** Area fractions of phases 0 to @p n_phases - 1; they sum to one. */
std::vector<double> area_fractions(const PhaseMap<2> &map, const unsigned int n_phases);

/** The same morphology on a grid with a whole multiple of the cells of @p map. */
PhaseMap<2> refined_map(const PhaseMap<2> &map, const UniformGrid<2> &grid);
} // namespace mesoslip

#endif
