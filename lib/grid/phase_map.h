#ifndef mesoslip_grid_phase_map_h
#define mesoslip_grid_phase_map_h

#include "grid/uniform_grid.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/**
 * The morphology on a uniform grid: one phase index for each cell, x fastest,
 * `id.size() == grid.n_cells()`.
 */
template <int dim>
struct PhaseMap
{
  UniformGrid<dim> grid;        ///< the cells
  std::vector<std::uint8_t> id; ///< of each cell, x fastest
};
} // namespace mesoslip

#endif
