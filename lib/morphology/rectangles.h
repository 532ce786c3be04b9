#ifndef mesoslip_morphology_rectangles_h
#define mesoslip_morphology_rectangles_h

#include "morphology/cell_box.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** An axis-parallel rectangle of one phase, lengths in metres. */
struct Rectangle
{
  double x_left;          ///< m
  double y_bottom;        ///< m
  double width;           ///< m
  double height;          ///< m
  std::uint8_t phase = 1; ///< index
};

/**
 * The cells that belong to a rectangle: those whose centre lies inside
 * [x_left, x_left + width) x [y_bottom, y_bottom + height). Edges count as displaced by
 * -1e-6 of a cell, so that an edge which is a cell centre up to round-off is treated
 * the same way everywhere. Clipped at the box; empty when no centre is inside.
 */
CellBox covered_cells(const UniformGrid<2> &grid, const Rectangle &rectangle);

/**
 * Draws rectangles on a background of phase 0; where they overlap the later one wins.
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

/** Writes what read_rectangles() reads, to the picometre. Throws UserError. */
void write_rectangles(const std::string &file, const std::vector<Rectangle> &rectangles);
} // namespace mesoslip

#endif
