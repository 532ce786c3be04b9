#include "morphology/cell_box.h"

#include <algorithm>

namespace mesoslip
{
PhaseMap<2> homogeneous_map(const UniformGrid<2> &grid, const std::uint8_t background)
{
  return {grid, std::vector<std::uint8_t>(grid.n_cells(), background)};
}

void fill_box(PhaseMap<2> &map, const CellBox &box, const std::uint8_t phase)
{
  for (unsigned int y = box.y_begin; y < box.y_end && !box.empty(); ++y)
    {
      const auto row =
        map.id.begin() + static_cast<std::ptrdiff_t>(y) * map.grid.cells[0];
      std::fill(row + box.x_begin, row + box.x_end, phase);
    }
}

std::vector<double> area_fractions(const PhaseMap<2> &map, const unsigned int n_phases)
{
  std::vector<double> fractions;
  for (unsigned int p = 0; p < n_phases; ++p)
    fractions.push_back(static_cast<double>(std::count(map.id.begin(), map.id.end(), p)) /
                        static_cast<double>(map.id.size()));
  return fractions;
}

PhaseMap<2> refined_map(const PhaseMap<2> &map, const UniformGrid<2> &grid)
{
  const unsigned int x_ratio = grid.cells[0] / map.grid.cells[0];
  const unsigned int y_ratio = grid.cells[1] / map.grid.cells[1];
  PhaseMap<2> result{grid, {}};
  result.id.reserve(grid.n_cells());
  for (unsigned int y = 0; y < grid.cells[1]; ++y)
    for (unsigned int x = 0; x < grid.cells[0]; ++x)
      result.id.push_back(
        map.id[static_cast<std::size_t>(y / y_ratio) * map.grid.cells[0] + x / x_ratio]);
  return result;
}
} // namespace mesoslip
