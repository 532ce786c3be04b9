#include "morphology/image_map.h"

#include "base/errors.h"
#include "grid/uniform_grid.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

namespace mesoslip
{
namespace
{
/** Pixels per cell, or cells per pixel, along each axis. */
struct Ratio
{
  std::array<unsigned int, 2> pixels = {{1, 1}}; ///< per cell
  std::array<unsigned int, 2> cells  = {{1, 1}}; ///< per pixel
};

Ratio ratio_of(const UniformGrid<2> &grid, const Image &image, const std::string &source)
{
  const std::array<unsigned int, 2> n_pixels = {{image.width, image.height}};
  const std::string numbers =
    source + ": the image has " + numbers_text(image.width, image.height) +
    " pixels and the grid " + numbers_text(grid.cells[0], grid.cells[1]) + " cells; ";
  const std::string advice = "set Grid/Cells = " + std::to_string(image.width) + ", " +
                             std::to_string(image.height);
  Ratio ratio;
  for (unsigned int d = 0; d < 2; ++d)
    if (n_pixels[d] == 0 ||
        (grid.cells[d] % n_pixels[d] != 0 && n_pixels[d] % grid.cells[d] != 0))
      throw UserError(numbers +
                      "along each side one must be a whole multiple of the "
                      "other; " +
                      advice);
    else if (grid.cells[d] >= n_pixels[d])
      ratio.cells[d] = grid.cells[d] / n_pixels[d];
    else
      ratio.pixels[d] = n_pixels[d] / grid.cells[d];
  for (unsigned int d = 0; d < 2; ++d)
    if (ratio.cells[d] > 1 && ratio.pixels[1 - d] > 1)
      throw UserError(numbers +
                      "one side would be refined and the other coarsened; are "
                      "the two numbers swapped? " +
                      advice);
  return ratio;
}

/** Throws if every row is a single number whose digits may be meant as pixels without
 * blanks. */
void require_no_rows_of_digits(const UniformGrid<2> &grid,
                               const Image &image,
                               const std::string &source)
{
  if (image.digits > 1 && grid.cells[0] % image.digits == 0)
    throw UserError(source + ": every row is one number of " +
                    std::to_string(image.digits) + " digits, and the grid has " +
                    std::to_string(grid.cells[0]) +
                    " cells along x; if every digit is a pixel, put blanks between "
                    "them, or else give the phases numbers of one digit");
}

void require_square_pixels(const UniformGrid<2> &grid,
                           const Image &image,
                           const std::string &source)
{
  const double width        = grid.extent(0) / image.width,
               height       = grid.extent(1) / image.height;
  constexpr double rounding = 0.01; // for sizes given with three digits
  if (!(std::abs(width - height) <= rounding * std::max(width, height)))
    throw UserError(source + ": its " + numbers_text(image.width, image.height) +
                    " pixels would be " + to_text(width) + " m wide and " +
                    to_text(height) +
                    " m high in the body; do Grid/Cells and Grid/Size belong to this "
                    "image, x before y? If its pixels are not square, set "
                    "Microstructure/Oblong pixels = true");
}

std::string value_text(const Image &image, const long value)
{
  if (!image.coloured)
    return std::to_string(value);
  char colour[16];
  std::snprintf(colour, sizeof colour, "#%06lx", static_cast<unsigned long>(value));
  return std::string(colour) + " (" + std::to_string(value) + ")";
}

/** Checks that every value of the image is in `values`. */
void require_phases(const std::set<int> &found,
                    const Image &image,
                    const std::vector<long> &values,
                    const std::string &source)
{
  const auto stray = std::find_if(found.begin(), found.end(), [&](const int value) {
    return std::count(values.begin(), values.end(), value) == 0;
  });
  if (stray == found.end())
    return;
  constexpr std::size_t most = 8; // number of values to list
  if (found.size() > most)
    throw UserError(source + ": the image has " + std::to_string(found.size()) +
                    " different values, and " + value_text(image, *stray) +
                    " belongs to no phase; use an image without smoothed edges, "
                    "segmented if it is a photograph, set Microstructure/Thresholds, or "
                    "add what is missing to Image values");
  std::string listed;
  for (const int value : found)
    listed += (listed.empty() ? "" : ", ") + value_text(image, value);
  throw UserError(source + ": the image has the value" +
                  (found.size() == 1 ? " " : "s ") + listed + ", and " +
                  value_text(image, *stray) +
                  " belongs to no phase; set Microstructure/Image values to those of "
                  "the image, one for each phase");
}

/** Value of each phase. */
std::vector<long> values_of_phases(const Image &image,
                                   const ImageReading &reading,
                                   const std::string &source)
{
  const std::set<int> found(image.values.begin(), image.values.end());
  if (!reading.values.empty())
    {
      require_phases(found, image, reading.values, source);
      return reading.values;
    }
  const std::string numbers = source + ": the image has " + std::to_string(found.size()) +
                              (found.size() == 1 ? " value" : " different values") +
                              " and there are " + std::to_string(reading.n_phases) +
                              " phases; ";
  if (found.size() > reading.n_phases)
    throw UserError(numbers + "name more phases, use an image without smoothed edges, "
                              "segmented if it is a photograph, or set "
                              "Microstructure/Thresholds");
  if (found.size() < reading.n_phases)
    throw UserError(
      numbers +
      "say with Microstructure/Image values which value is which "
      "phase (the image has " +
      value_text(image, *found.begin()) +
      (found.size() > 1 ? " to " + value_text(image, *found.rbegin()) : "") +
      "), or name fewer phases");
  return {found.begin(), found.end()};
}

/** Phases of the image by value; pixels are not counted yet. */
std::vector<ImagePhase> named_phases(const Image &image,
                                     const std::vector<long> &values,
                                     const std::vector<double> &thresholds)
{
  std::vector<ImagePhase> phases;
  for (const long value : values)
    phases.push_back({value_text(image, value), 0, 0.});
  for (std::size_t p = 0; !thresholds.empty() && p <= thresholds.size(); ++p)
    phases.push_back(
      {p == 0 ? "below " + to_text(thresholds[0])
       : p == thresholds.size()
         ? "from " + to_text(thresholds[p - 1]) + " on"
         : "from " + to_text(thresholds[p - 1]) + " to below " + to_text(thresholds[p]),
       0, 0.});
  return phases;
}

/**
 * Phase of each cell from the phases of its pixels, see map_from_image(). @p phase is
 * per pixel, @p width the number of pixels along x.
 */
std::vector<std::uint8_t> phases_of_cells(const UniformGrid<2> &grid,
                                          const Ratio &ratio,
                                          const std::vector<std::uint8_t> &phase,
                                          const std::size_t width,
                                          const std::size_t n_phases)
{
  // Per phase: deficit of pixels over the cells so far; pixels of this cell.
  std::vector<long> missing(n_phases, 0), counts(n_phases, 0);
  std::vector<std::uint8_t> id;
  id.reserve(grid.n_cells());
  for (unsigned int j = 0; j < grid.cells[1]; ++j)
    for (unsigned int i = 0; i < grid.cells[0]; ++i)
      {
        const std::size_t x = std::size_t{i / ratio.cells[0]} * ratio.pixels[0],
                          y = std::size_t{j / ratio.cells[1]} * ratio.pixels[1];
        std::fill(counts.begin(), counts.end(), 0);
        for (std::size_t row = y; row < y + ratio.pixels[1]; ++row)
          for (std::size_t column = x; column < x + ratio.pixels[0]; ++column)
            ++counts[phase[row * width + column]];
        const long most    = *std::max_element(counts.begin(), counts.end());
        std::size_t chosen = n_phases;
        for (std::size_t p = 0; p < n_phases; ++p)
          {
            missing[p] += counts[p];
            if (counts[p] == most && (chosen == n_phases || missing[p] > missing[chosen]))
              chosen = p;
          }
        missing[chosen] -= 1L * ratio.pixels[0] * ratio.pixels[1];
        id.push_back(static_cast<std::uint8_t>(chosen));
      }
  return id;
}
} // namespace

ImageMap map_from_image(const UniformGrid<2> &grid,
                        const Image &image,
                        const ImageReading &reading,
                        const std::string &source)
{
  require_no_rows_of_digits(grid, image, source);
  const Ratio ratio = ratio_of(grid, image, source);
  if (!reading.oblong_pixels)
    require_square_pixels(grid, image, source);
  const std::vector<double> &thresholds = reading.thresholds;
  if (!thresholds.empty() && image.coloured)
    throw UserError(source +
                    ": the image has colours, and Microstructure/Thresholds are for grey "
                    "values; set Image values, or save it as grey");
  std::vector<long> values;
  if (thresholds.empty())
    values = values_of_phases(image, reading, source);

  ImageMap result;
  result.map.grid = grid;
  result.pixels   = {{image.width, image.height}};
  result.phases   = named_phases(image, values, thresholds);
  const PhaseOfValue phase_of(thresholds, {values.begin(), values.end()});
  std::vector<std::uint8_t> phase(image.values.size());
  for (std::size_t i = 0; i < phase.size(); ++i)
    {
      phase[i] = static_cast<std::uint8_t>(phase_of(image.values[i]));
      ++result.phases[phase[i]].n_pixels;
    }
  for (ImagePhase &p : result.phases)
    p.fraction = static_cast<double>(p.n_pixels) / static_cast<double>(phase.size());

  result.map.id = phases_of_cells(grid, ratio, phase, image.width, result.phases.size());
  return result;
}
} // namespace mesoslip
