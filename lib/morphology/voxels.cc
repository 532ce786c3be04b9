#include "morphology/voxels.h"

#include "base/errors.h"
#include "base/text.h"
#include "material/plausibility.h"
#include "morphology/microstructure_parameters.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mesoslip
{
namespace
{
std::string voxel_numbers(const std::array<unsigned int, 3> &n)
{
  return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
         std::to_string(n[2]);
}

std::string percent_text(const double fraction)
{
  return brief_text(4, 100. * fraction, " %");
}

/** Phases of the cells in the corners, from which the order of the axes shows. */
std::string corners_line(const PhaseMap<3> &map, const std::vector<Phase<3>> &phases)
{
  const auto &n    = map.grid.cells;
  std::string text = "Corners:";
  for (unsigned int corner = 0; corner < 8; ++corner)
    {
      std::array<std::size_t, 3> at = {};
      std::string place;
      for (unsigned int d = 0; d < 3; ++d)
        {
          const bool upper = (corner >> d & 1U) != 0;
          at[d]            = upper ? n[d] - 1 : 0;
          place += std::string(d == 0 ? "" : " ") + "xyz"[d] + (upper ? "+" : "-");
        }
      const std::size_t k = (at[2] * n[1] + at[1]) * n[0] + at[0];
      text += (corner == 0 ? " (" : ", (") + place + ") " + phases[map.id[k]].name;
    }
  return text;
}

/** Fraction of the last phase in up to four slices across each axis. */
std::vector<std::string> slice_lines(const PhaseMap<3> &map,
                                     const std::vector<Phase<3>> &phases)
{
  std::vector<std::string> lines;
  const auto &n              = map.grid.cells;
  const std::uint8_t counted = phases.size() - 1;
  std::size_t stride         = 1;
  for (unsigned int d = 0; d < 3; ++d)
    {
      const unsigned int n_slices = std::min(4U, n[d]);
      std::vector<double> all(n_slices, 0.), part(n_slices, 0.);
      for (std::size_t k = 0; k < map.id.size(); ++k)
        {
          const std::size_t slice = k / stride % n[d] * n_slices / n[d];
          all[slice] += 1.;
          part[slice] += map.id[k] == counted ? 1. : 0.;
        }
      std::string line = "Slices across " + std::string(1, "xyz"[d]) +
                         ", from below: " + phases[counted].name;
      for (unsigned int s = 0; s < n_slices; ++s)
        line += (s == 0 ? " " : ", ") + percent_text(part[s] / all[s]);
      lines.push_back(line);
      stride *= n[d];
    }
  return lines;
}

void describe_phases(VoxelMorphology &result, const std::vector<PhaseParameters> &phases)
{
  std::vector<std::size_t> count(phases.size(), 0);
  for (const std::uint8_t id : result.map.id)
    ++count[id];
  const auto n = static_cast<double>(result.map.id.size());
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      result.fractions.push_back(static_cast<double>(count[p]) / n);
      result.description.push_back("Phase " + std::to_string(p) + ", " + phases[p].name +
                                   ": " + std::to_string(count[p]) + " cells, " +
                                   percent_text(result.fractions[p]) + "; " +
                                   phases[p].text<3>());
      if (count[p] == 0)
        result.warnings.push_back("phase '" + phases[p].name +
                                  "' of Phases/Names fills no cell of the morphology; "
                                  "mend what tells the phases apart, or leave its "
                                  "name out");
    }
}
/** Places the inclusions, or says why there is no room for as many. */
void place_inclusions(VoxelMorphology &result, const MicrostructureParameters &p)
{
  const InclusionPlacement &rules = p.inclusions;
  InclusionMorphology placed      = place_random_inclusions(
         p.box, rules, static_cast<std::uint8_t>(p.fibre_phase_index()));
  const double reached = placed.reached_fraction(rules.fraction_rule);
  const std::string n  = std::to_string(placed.inclusions.size()) + " ";
  if (!placed.target_reached)
    throw UserError(random_inclusions_section +
                    "/Volume fraction: " + percent_text(rules.volume_fraction) +
                    " cannot be reached, as " + n + rules.name_of_shape() + " of seed " +
                    std::to_string(rules.seed) + " make " + percent_text(reached) +
                    " and " + std::to_string(placed.vain_draws) +
                    " draws found no place for another one; ask for less" +
                    (rules.allow_overlap ? "" : ", or set Allow overlap = true"));
  if (std::fabs(reached - rules.volume_fraction) > 0.01)
    result.warnings.push_back(random_inclusions_section +
                              "/Volume fraction: " + percent_text(rules.volume_fraction) +
                              " asked for, " + percent_text(reached) + " reached, as " +
                              n + rules.name_of_shape() +
                              " are too few to come nearer; take a larger box or smaller "
                              "ones");
  const bool both = rules.allow_overlap;
  result.description.push_back(
    "Morphology: " + n + "random " + rules.name_of_shape() + " of seed " +
    std::to_string(rules.seed) + "; " + percent_text(rules.volume_fraction) +
    " wanted, " + percent_text(placed.actual_fraction) + " of the cells reached" +
    (both
       ? ", " + percent_text(placed.nominal_fraction) + " with overlaps counted each time"
       : ""));
  result.map = std::move(placed.map);
}

/** Reads the file of voxels. */
void read_voxels(VoxelMorphology &result, const MicrostructureParameters &p)
{
  const auto file          = VoxelFile::open(p.voxels.source(p.file));
  const VoxelRegion region = region_of_voxels(p, file->shape());
  CellPhases cells         = read_cell_phases(p, *file, region);
  result.map.id            = std::move(cells.id);
  const auto numbers       = [](const std::array<std::size_t, 3> &n) {
    return std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
           std::to_string(n[2]);
  };
  const std::string n = std::to_string(p.voxels.coarsening);
  std::string text =
    "Morphology: voxels of " + std::filesystem::path(p.file).filename().string();
  if (region.size !=
      std::array<std::size_t, 3>{{file->shape()[2], file->shape()[1], file->shape()[0]}})
    text += ", " + numbers(region.size) + " of them from (" +
            std::to_string(region.from[0]) + ", " + std::to_string(region.from[1]) +
            ", " + std::to_string(region.from[2]) + ") on";
  result.description.push_back(text + (p.voxels.coarsening == 1
                                         ? ", one per cell"
                                         : ", " + n + " x " + n + " x " + n +
                                             " per cell, of which the majority decides"));
  describe_phases(result, p.phases);
  for (std::size_t k = 0; k < p.phases.size(); ++k)
    if (const double before = cells.fractions[k], after = result.fractions[k];
        !(std::fabs(after - before) <= std::min(0.01, 0.1 * before)))
      result.warnings.push_back("phase '" + p.phases[k].name + "' is " +
                                percent_text(before) + " of the voxels and " +
                                percent_text(after) +
                                " of the cells, as each cell takes the majority of its "
                                "voxels; for the composite of the file reduce "
                                "Microstructure/Coarsening");
}

/** The orientations of the cells, if there is a file of them. */
void read_orientations(VoxelMorphology &result, const MicrostructureParameters &p)
{
  if (p.orientation.file.empty())
    return;
  CellOrientations found = read_cell_orientations(p, result.map.id, result.phases);
  result.orientations    = std::move(found.orientations);
  for (const std::string &line : found.description)
    result.description.push_back(line);
  for (const std::string &warning : found.warnings)
    result.warnings.push_back(warning);
}

void describe_places(VoxelMorphology &result)
{
  result.description.push_back(corners_line(result.map, result.phases));
  for (const std::string &line : slice_lines(result.map, result.phases))
    result.description.push_back(line);
}
} // namespace

VoxelMorphology make_voxels(const MicrostructureParameters &parameters)
{
  using Type = MicrostructureParameters::Type;
  VoxelMorphology result;
  const UniformGrid<3> &grid = parameters.box;
  result.map.grid            = grid;
  result.phases              = make_phases<3>(parameters.phases);
  result.description         = {"Grid: " + voxel_numbers(grid.cells) + " cells of " +
                                brief_text(4, grid.spacing[0], " x ", grid.spacing[1], " x ",
                                           grid.spacing[2], " m, ", grid.extent(0), " x ",
                                           grid.extent(1), " x ", grid.extent(2), " m")};
  if (parameters.type == Type::homogeneous)
    {
      result.map.id.assign(grid.n_cells(), 0);
      result.description.emplace_back("Morphology: homogeneous");
      describe_phases(result, parameters.phases);
      result.warnings.clear();
      read_orientations(result, parameters);
      return result;
    }
  if (parameters.type == Type::random_inclusions)
    {
      place_inclusions(result, parameters);
      describe_phases(result, parameters.phases);
    }
  else
    read_voxels(result, parameters);
  describe_places(result);
  read_orientations(result, parameters);
  return result;
}
} // namespace mesoslip
