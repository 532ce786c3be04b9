#include "base/errors.h"
#include "grid/uniform_grid.h"
#include "morphology/image_map.h"
#include "morphology/microstructure_parameters.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mesoslip
{
namespace
{
using Type = MicrostructureParameters::Type;

std::string percent(const double fraction)
{
  return to_text(std::round(fraction * 1e5) / 1e3) + " %";
}

std::string file_name(const std::string &path)
{
  return std::filesystem::path(path).filename().string();
}

/** Warning if coarse cells change the fraction of a phase; else empty. */
std::string coarsening_warning(const ImageMap &image,
                               const std::vector<PhaseParameters> &parameters)
{
  // Fibres eight times as stiff as their matrix contribute seven times their fraction: 1
  // % more fibres change the stiffness by some percent. The contribution of a rare phase
  // changes in proportion.
  constexpr double absolute = 0.01, relative = 0.1;
  std::string changes;
  const auto fractions = area_fractions(image.map, image.phases.size());
  for (std::size_t p = 0; p < fractions.size(); ++p)
    if (const double before = image.phases[p].fraction;
        !(std::abs(fractions[p] - before) <= std::min(absolute, relative * before)))
      changes += (changes.empty() ? "phase '" : ", phase '") + parameters[p].name +
                 "' is " + percent(before) + " of the image and " +
                 percent(fractions[p]) + " of the cells";
  return changes.empty() ? ""
                         : changes + ", as each cell takes the majority of its pixels; "
                                     "for the composite of the image increase Grid/Cells";
}

std::string image_text(const ImageMap &image, const std::string &file)
{
  const UniformGrid<2> &grid = image.map.grid;
  const unsigned int n_x = image.pixels[0], n_y = image.pixels[1];
  std::string text = "Morphology: " + numbers_text(n_x, n_y) + " pixels of " +
                     file_name(file) + ", each " +
                     lengths_text(grid.extent(0) / n_x, grid.extent(1) / n_y);
  if (n_x == grid.cells[0] && n_y == grid.cells[1])
    return text + ", one per cell";
  if (n_x >= grid.cells[0] && n_y >= grid.cells[1])
    return text + ", " + numbers_text(n_x / grid.cells[0], n_y / grid.cells[1]) +
           " per cell, of which the majority decides";
  return text + ", " + numbers_text(grid.cells[0] / n_x, grid.cells[1] / n_y) +
         " cells per pixel";
}

/** A line for each phase. */
std::vector<std::string> phase_texts(const PhaseMap<2> &map,
                                     const std::vector<PhaseParameters> &parameters,
                                     const std::vector<ImagePhase> &image)
{
  std::vector<std::string> lines;
  const std::size_t n  = parameters.size();
  const auto fractions = area_fractions(map, static_cast<unsigned int>(n));
  for (std::size_t p = 0; p < n; ++p)
    {
      const double n_cells =
        std::round(fractions[p] * static_cast<double>(map.id.size()));
      std::string line = "Phase " + std::to_string(p) + ", " + parameters[p].name + ": ";
      if (!image.empty())
        line += "value " + image[p].value + ", " + percent(image[p].fraction) +
                " of the pixels, ";
      lines.push_back(line + to_text(n_cells) + " cells, " + percent(fractions[p]) +
                      "; " + parameters[p].text<2>());
    }
  return lines;
}

Microstructure read_image_map(const MicrostructureParameters &p)
{
  const ImageMap image = map_from_image(p.grid, read_image(p.file), p.image, p.file);
  Microstructure result;
  result.map = image.map;
  if (const std::string warning = coarsening_warning(image, p.phases); !warning.empty())
    result.warnings.push_back(warning);
  result.description = phase_texts(image.map, p.phases, image.phases);
  result.description.insert(result.description.begin(), image_text(image, p.file));
  return result;
}

/** Reads a morphology from a file. */
Microstructure read_microstructure(const MicrostructureParameters &p)
{
  const std::size_t n_phases = p.phases.size();
  require_readable_file("Microstructure/File: ", p.file,
                        p.type == Type::image
                          ? "it has to name an image, relative to the .prm file"
                          : "it has to name a list of rectangles, relative to "
                            "the .prm file");
  if (p.type == Type::image)
    return read_image_map(p);
  Microstructure result;
  result.rectangles = read_rectangles(p.file, p.grid);
  for (std::size_t i = 0; i < result.rectangles.size(); ++i)
    if (result.rectangles[i].phase >= n_phases)
      throw UserError(p.file + ": rectangle " + std::to_string(i + 1) +
                      " has the phase " + std::to_string(result.rectangles[i].phase) +
                      ", and Phases/Names has only 0 to " + std::to_string(n_phases - 1));
  result.map         = draw_rectangles(p.grid, result.rectangles);
  result.description = {"Morphology: " + std::to_string(result.rectangles.size()) +
                        " rectangles of " + file_name(p.file)};
  return result;
}

/** Warnings on fibre sizes changed by rounding to the grid. */
std::vector<std::string> rounding_warnings(const FibrePlacement &p,
                                           const UniformGrid<2> &grid)
{
  std::vector<std::string> warnings;
  const auto look = [&](const char *key, const double length, const double h) {
    if (!is_multiple(length, h))
      warnings.push_back(random_fibres_section + "/" + key + ": " + to_text(length) +
                         " m is no multiple of the cell, " + to_text(h) + " m; " +
                         (p.align_to_grid ? "it is rounded to " +
                                              to_text(std::round(length / h) * h) + " m"
                                          : "fibres differ by up to a cell"));
  };
  look("Fibre width", p.width, grid.spacing[0]);
  if (p.align_to_grid)
    {
      look("Minimum height", p.min_height, grid.spacing[1]);
      look("Maximum height", p.max_height, grid.spacing[1]);
    }
  return warnings;
}

Microstructure place_microstructure(const MicrostructureParameters &p)
{
  FibrePlacement rules = p.placement;
  rules.phase          = static_cast<std::uint8_t>(p.fibre_phase_index());

  const UniformGrid<2> placement_grid = p.placement_grid();
  const FibreMorphology placed        = place_random_fibres(placement_grid, rules);

  Microstructure result;
  result.warnings = rounding_warnings(rules, placement_grid);
  if (!placed.target_reached)
    result.warnings.push_back(
      random_fibres_section + "/Area fraction: " + percent(rules.area_fraction) +
      " asked for, " + percent(placed.reached_fraction(rules.fraction_rule)) +
      " reached with " + std::to_string(placed.fibres.size()) +
      " fibres; no further one fits in under these rules");
  result.map         = refined_map(placed.map, p.grid);
  result.rectangles  = placed.fibres;
  result.description = {"Morphology: " + std::to_string(placed.fibres.size()) +
                        " random fibres of seed " + std::to_string(rules.seed)};
  return result;
}

} // namespace

Microstructure make_microstructure(const MicrostructureParameters &parameters)
{
  Microstructure result;
  if (parameters.type == Type::homogeneous)
    {
      result.map         = homogeneous_map(parameters.grid);
      result.description = {"Morphology: homogeneous"};
    }
  else if (parameters.type == Type::random_fibres)
    result = place_microstructure(parameters);
  else
    result = read_microstructure(parameters);
  result.phases = make_phases<2>(parameters.phases);
  if (result.description.size() == 1)
    for (const std::string &line : phase_texts(result.map, parameters.phases, {}))
      result.description.push_back(line);
  for (const PhaseParameters &phase : parameters.phases)
    if (std::fabs(phase.angle) > 2. * M_PI)
      result.warnings.push_back(
        "'Phases/" + phase.name + "/Angle' is " + to_text(phase.angle) +
        " rad, more than a full turn; " + to_text(phase.angle) + " degrees would be " +
        to_text(std::round(phase.angle * M_PI / 180. * 1e6) / 1e6) + " rad");
  // Single-phase input (an image of one grey level, a list without rectangles) is no
  // error, but no composite.
  const std::vector<double> fractions = area_fractions(result.map, result.phases.size());
  for (std::size_t p = 0; p < fractions.size(); ++p)
    if (fractions[p] == 0. && parameters.type != Type::homogeneous)
      result.warnings.push_back("phase '" + result.phases[p].name +
                                "' of Phases/Names fills no cell of the morphology; mend "
                                "what tells the phases apart, or leave its "
                                "name out");
  return result;
}
} // namespace mesoslip
