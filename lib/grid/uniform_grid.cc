#include "grid/uniform_grid.h"

#include <algorithm>
#include <sstream>
#include <utility>

namespace mesoslip
{
std::string numbers_text(const unsigned int width, const unsigned int height)
{
  return std::to_string(width) + " x " + std::to_string(height);
}

std::string lengths_text(const double width, const double height)
{
  const double largest    = std::max(width, height) * (1. + 1e-9);
  const auto [unit, name] = largest >= 1e3    ? std::pair(1e3, " km")
                            : largest >= 1.   ? std::pair(1., " m")
                            : largest >= 1e-4 ? std::pair(1e-3, " mm")
                                              : std::pair(1e-6, " um");
  std::ostringstream text;
  text.precision(4);
  text << width / unit << " x " << height / unit << name;
  return text.str();
}

std::string size_text(const UniformGrid<2> &grid)
{
  return std::to_string(grid.cells[0]) + " x " + std::to_string(grid.cells[1]) +
         " cells of " + lengths_text(grid.spacing[0], grid.spacing[1]) + ", " +
         lengths_text(grid.extent(0), grid.extent(1));
}
} // namespace mesoslip
