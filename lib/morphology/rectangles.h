#ifndef mesoslip_morphology_rectangles_h
#define mesoslip_morphology_rectangles_h

#include "grid/uniform_grid.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace mesoslip
{
/** Half-open ranges of cells [x_begin, x_end) x [y_begin, y_end). */
struct CellBox
{
  unsigned int x_begin; ///< first column
  unsigned int x_end;   ///< index after the last column
  unsigned int y_begin; ///< first row
  unsigned int y_end;   ///< index after the last row

  /** Whether the box has no cells. */
  bool empty() const
  {
    return x_begin >= x_end || y_begin >= y_end;
  }

  /** Number of cells, width times height. */
  std::size_t n_cells() const
  {
    return empty() ? 0 : std::size_t(x_end - x_begin) * (y_end - y_begin);
  }
};

/**
 * Marks the cells of a grid that belong to fibres. Cells of a column are contiguous,
 * because fibres are tall. Boxes lie inside the grid.
 */
class Occupancy
{
public:
  /** Initially all cells are free. */
  Occupancy(const unsigned int n_columns, const unsigned int n_rows)
    : columns(n_columns)
    , rows(n_rows)
    , taken(static_cast<std::size_t>(n_columns) * n_rows, 0)
  {
  }

  /** Whether all cells of the box are free. */
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

  /** Marks all cells of @p box as taken. */
  void mark(const CellBox &box)
  {
    number += n_free(box);
    for (unsigned int x = box.x_begin; x < box.x_end && !box.empty(); ++x)
      std::memset(&taken[first(x, box)], 1, box.y_end - box.y_begin);
  }

  /** Number of taken cells. */
  std::size_t n_taken() const
  {
    return number;
  }

  /** The box enlarged by @p x_gap and @p y_gap cells, clipped at the grid. */
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
  std::vector<char> taken; ///< 1 for a taken cell, [columns][rows]
  std::size_t number = 0;  ///< number of taken cells
};

/** A map with all cells in phase @p background. */
PhaseMap<2> homogeneous_map(const UniformGrid<2> &grid,
                            const std::uint8_t background = 0);

/** Assigns all cells of a box, which lies inside the grid, to @p phase. */
void fill_box(PhaseMap<2> &map, const CellBox &box, const std::uint8_t phase);

/** Area fractions of phases 0 to @p n_phases - 1; they sum to one. */
std::vector<double> area_fractions(const PhaseMap<2> &map, const unsigned int n_phases);

/** The morphology on a refined grid: each cell of @p map becomes a block of cells. */
PhaseMap<2> refined_map(const PhaseMap<2> &map, const UniformGrid<2> &grid);

/** An axis-parallel rectangle of one phase, lengths in metres. */
struct Rectangle
{
  double x_left;          ///< m
  double y_bottom;        ///< m
  double width;           ///< m
  double height;          ///< m
  std::uint8_t phase = 1; ///< phase number
};

/**
 * The cells of a rectangle: their centre lies inside [x_left, x_left + width) x
 * [y_bottom, y_bottom + height). Edges are shifted by -1e-6 of a cell, so that an edge
 * at a cell centre up to round-off is treated the same way everywhere. Clipped at the
 * box; empty if no centre is inside.
 */
CellBox covered_cells(const UniformGrid<2> &grid, const Rectangle &rectangle);

/**
 * Draws rectangles on a background of phase 0; later rectangles overwrite earlier ones.
 * Rectangles that leave the box are cut.
 */
PhaseMap<2> draw_rectangles(const UniformGrid<2> &grid,
                            const std::vector<Rectangle> &rectangles);

/**
 * Reads `x_left_mm,y_bottom_mm,width_mm,height_mm[,phase]`, lengths in millimetres;
 * phase 1 where the column is missing. Empty lines and lines starting with # are skipped.
 * Rectangles that lie wholly outside the @p grid or cover no cell centre are errors, too.
 * Throws UserError with file and line.
 */
std::vector<Rectangle> read_rectangles(const std::string &file,
                                       const UniformGrid<2> &grid);

/** Writes a file for read_rectangles(), with a resolution of a picometre. Throws
 * UserError. */
void write_rectangles(const std::string &file, const std::vector<Rectangle> &rectangles);
} // namespace mesoslip

#endif
