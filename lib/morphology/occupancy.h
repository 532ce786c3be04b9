#ifndef mesoslip_morphology_occupancy_h
#define mesoslip_morphology_occupancy_h

#include "morphology/cell_box.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace mesoslip
{
/**
 * Whether a fibre has a cell, for all cells of a grid. Cells of a column lie side by side,
 * because fibres are tall. Boxes lie inside the grid.
 */
class Occupancy
{
public:
  /** All cells free. */
  Occupancy(const unsigned int n_columns, const unsigned int n_rows)
    : columns(n_columns)
    , rows(n_rows)
    , taken(static_cast<std::size_t>(n_columns) * n_rows, 0)
  {
  }

  /** Whether no cell of the box is taken. */
  bool is_free(const CellBox &box) const
  {
    for (unsigned int x = box.x_begin; x < box.x_end && !box.empty(); ++x)
      if (std::memchr(&taken[first(x, box)], 1, box.y_end - box.y_begin) != nullptr)
        return false;
    return true;
  }

  /** Number of free cells of the box. */
  std::size_t n_free(const CellBox &box) const
  {
    std::size_t n = 0;
    for (unsigned int x = box.x_begin; x < box.x_end && !box.empty(); ++x)
      {
        const char *const cells = &taken[first(x, box)];
        n += static_cast<std::size_t>(
          std::count(cells, cells + (box.y_end - box.y_begin), char(0)));
      }
    return n;
  }

  /** Takes all cells of @p box. */
  void mark(const CellBox &box)
  {
    number += n_free(box);
    for (unsigned int x = box.x_begin; x < box.x_end && !box.empty(); ++x)
      std::memset(&taken[first(x, box)], 1, box.y_end - box.y_begin);
  }

  /** Number of cells taken. */
  std::size_t n_taken() const
  {
    return number;
  }

  /** The box with @p x_gap and @p y_gap cells around it, as far as inside the grid. */
  CellBox
  widened(const CellBox &box, const unsigned int x_gap, const unsigned int y_gap) const
  {
    return {box.x_begin - std::min(box.x_begin, x_gap),
            box.x_end + std::min(columns - box.x_end, x_gap),
            box.y_begin - std::min(box.y_begin, y_gap),
            box.y_end + std::min(rows - box.y_end, y_gap)};
  }

private:
  /** Index of the lowest cell of a box in column @p x. */
  std::size_t first(const unsigned int x, const CellBox &box) const
  {
    return static_cast<std::size_t>(x) * rows + box.y_begin;
  }

  unsigned int columns, rows;
  std::vector<char> taken; ///< 1 for each cell that is taken, [columns][rows]
  std::size_t number = 0;  ///< of cells taken
};
} // namespace mesoslip

#endif
