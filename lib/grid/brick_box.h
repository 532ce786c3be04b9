#ifndef mesoslip_grid_brick_box_h
#define mesoslip_grid_brick_box_h

#include "grid/uniform_grid.h"

namespace mesoslip
{
/** A box of equal bricks; opposite sides may be periodic. */
struct BrickBox
{
  UniformGrid<3> grid;               ///< grid of the cells
  std::array<bool, 2> periodic = {}; ///< whether x and y are periodic
};
} // namespace mesoslip

#endif
