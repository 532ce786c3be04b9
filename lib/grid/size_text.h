#ifndef mesoslip_grid_size_text_h
#define mesoslip_grid_size_text_h

#include "grid/uniform_grid.h"

#include <string>

namespace mesoslip
{
/** "560 x 160": two numbers of cells or pixels. */
std::string numbers_text(const unsigned int width, const unsigned int height);

/** "0.1 x 0.2 mm": two lengths (m) with the unit that suits the larger one. */
std::string lengths_text(const double width, const double height);

/** "560 x 160 cells of 0.1 x 0.1 mm, 56 x 16 mm"; lengths in km, m, mm or um. */
std::string size_text(const UniformGrid<2> &grid);
} // namespace mesoslip

#endif
