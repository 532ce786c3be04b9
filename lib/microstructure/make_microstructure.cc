#include "io/errors.h"
#include "io/parameters.h"
#include "microstructure/image_map.h"
#include "microstructure/microstructure_parameters.h"
#include "microstructure/statistics.h"

#include <cmath>

namespace mesoslip
{
namespace
{
using Type = MicrostructureParameters::Type;

/** The morphologies that come from a file. */
Microstructure read_microstructure(const MicrostructureParameters &p)
{
  const UniformGrid<2> grid = p.grid.grid();
  const auto n_phases       = static_cast<unsigned int>(p.phases.phases.size());
  require_input_file("Microstructure/File: ", p.file,
                     p.type == Type::image ? "it has to name an image"
                                           : "it has to name a list of rectangles");
  Microstructure result;
  if (p.type == Type::image)
    {
      result.map = read_phase_map(grid, p.file, p.image_values, n_phases);
      return result;
    }
  result.rectangles = read_rectangles(p.file, &grid);
  for (std::size_t i = 0; i < result.rectangles.size(); ++i)
    if (result.rectangles[i].phase >= n_phases)
      throw UserError(p.file + ": rectangle " + std::to_string(i + 1) +
                      " has the phase " + std::to_string(result.rectangles[i].phase) +
                      ", and Phases/Names has only 0 to " + std::to_string(n_phases - 1));
  result.map = draw_rectangles(grid, result.rectangles, p.file);
  return result;
}

std::string percent(const double fraction)
{
  return to_text(std::round(fraction * 1e5) / 1e3) + " %";
}

/** Sentences about fibre sizes that the grid changes. */
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

  const UniformGrid<2> grid           = p.grid.grid();
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
  result.map        = refined_map(placed.map, grid);
  result.rectangles = placed.fibres;
  return result;
}
} // namespace

namespace
{
/** A picture of one grey, a list without rectangles of a phase: no error, but no
 * composite. */
std::vector<std::string> empty_phases(const PhaseMap<2> &map,
                                      const std::vector<Phase<2>> &phases)
{
  std::vector<std::string> warnings;
  const std::vector<double> fractions = area_fractions(map, phases.size());
  for (std::size_t p = 0; p < phases.size(); ++p)
    if (fractions[p] == 0.)
      warnings.push_back("phase '" + phases[p].name +
                         "' of Phases/Names fills no cell of the morphology");
  return warnings;
}
} // namespace

Microstructure make_microstructure(const MicrostructureParameters &parameters)
{
  Microstructure result;
  if (parameters.type == Type::homogeneous)
    result.map = homogeneous_map(parameters.grid.grid());
  else if (parameters.type == Type::random_fibres)
    result = place_microstructure(parameters);
  else
    result = read_microstructure(parameters);
  result.phases = parameters.phases.make_phases();
  if (parameters.type != Type::homogeneous)
    for (const std::string &warning : empty_phases(result.map, result.phases))
      result.warnings.push_back(warning);
  return result;
}
} // namespace mesoslip
