#include "microstructure/image_map.h"

#include "io/errors.h"
#include "io/parameters.h"

#include <map>

namespace mesoslip
{
namespace
{
/** The pixel of each cell along one direction; empty when the numbers do not fit. */
std::vector<unsigned int> pixels_of_cells(const unsigned int n_cells,
                                          const unsigned int n_pixels)
{
  std::vector<unsigned int> pixel;
  if (n_pixels == 0 || (n_cells % n_pixels != 0 && n_pixels % n_cells != 0))
    return pixel;
  const bool coarse        = n_cells >= n_pixels;
  const unsigned int ratio = coarse ? n_cells / n_pixels : n_pixels / n_cells;
  for (unsigned int i = 0; i < n_cells; ++i)
    pixel.push_back(coarse ? i / ratio : i * ratio + ratio / 2);
  return pixel;
}

std::map<int, std::uint8_t> phase_of_value(const Image &image,
                                           const std::vector<long> &values,
                                           const unsigned int n_phases,
                                           const std::string &source)
{
  const std::vector<int> found = image.distinct_values();
  std::map<int, std::uint8_t> phase;
  if (values.empty())
    {
      if (found.size() > n_phases)
        throw UserError(source + ": the image has " + std::to_string(found.size()) +
                        " different values and there are " + std::to_string(n_phases) +
                        " phases; name more phases, or use an image without smoothed "
                        "edges");
      for (std::size_t p = 0; p < found.size(); ++p)
        phase[found[p]] = static_cast<std::uint8_t>(p);
      return phase;
    }
  for (std::size_t p = 0; p < values.size(); ++p)
    phase[static_cast<int>(values[p])] = static_cast<std::uint8_t>(p);
  for (const int value : found)
    if (phase.count(value) == 0)
      throw UserError(source + ": the image has the value " + std::to_string(value) +
                      ", which belongs to no phase; add it to the image values");
  return phase;
}
} // namespace

PhaseMap<2> map_from_image(const UniformGrid<2> &grid,
                           const Image &image,
                           const std::vector<long> &values,
                           const unsigned int n_phases,
                           const std::string &source)
{
  const auto x_pixel = pixels_of_cells(grid.cells[0], image.width);
  const auto y_pixel = pixels_of_cells(grid.cells[1], image.height);
  if (x_pixel.empty() || y_pixel.empty())
    throw UserError(source + ": the image has " + std::to_string(image.width) + " x " +
                    std::to_string(image.height) + " pixels and the grid " +
                    std::to_string(grid.cells[0]) + " x " +
                    std::to_string(grid.cells[1]) +
                    " cells; along each side one must be a whole multiple of the other");
  const auto phase = phase_of_value(image, values, n_phases, source);

  PhaseMap<2> map{grid, {}};
  map.id.reserve(grid.n_cells());
  for (const unsigned int y : y_pixel)
    for (const unsigned int x : x_pixel)
      map.id.push_back(phase.at(image(x, y)));
  return map;
}

PhaseMap<2> read_phase_map(const UniformGrid<2> &grid,
                           const std::string &file,
                           const std::vector<long> &values,
                           const unsigned int n_phases)
{
  return map_from_image(grid, read_image(file), values, n_phases, file);
}
} // namespace mesoslip
