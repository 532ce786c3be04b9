#ifndef checkerboard_h
#define checkerboard_h

#include <grid/uniform_grid.h>

/** Squares of @p side cells, phases 0 and 1 in turn, phase 0 in the lower left corner. */
inline mesoslip::PhaseMap<2> checkerboard(const mesoslip::UniformGrid<2> &grid,
                                          const unsigned int side)
{
  mesoslip::PhaseMap<2> map;
  map.grid = grid;
  map.id.resize(grid.n_cells());
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      map.id[j * grid.cells[0] + i] = (i / side + j / side) % 2;
  return map;
}

#endif
