#include "morphology/voxels.h"

#include "base/errors.h"
#include "base/exchange.h"
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

/** Phases of the cells in the corners, as a check of the order of the axes. */
std::string corners_line(const VoxelMorphology &cells, const MPI_Comm communicator)
{
  const auto &n           = cells.grid.cells;
  const PlaneRange planes = own_planes(n[2], communicator);
  std::vector<double> phase(8, 0.);
  std::vector<std::string> places;
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
      places.push_back(place);
      if (const std::size_t plane = at[2] - planes.first; plane < planes.count)
        phase[corner] = cells.phase_id[(plane * n[1] + at[1]) * n[0] + at[0]];
    }
  sum_over_ranks(phase, communicator);
  std::string text = "Corners:";
  for (unsigned int corner = 0; corner < 8; ++corner)
    text += (corner == 0 ? " (" : ", (") + places[corner] + ") " +
            cells.phases[static_cast<std::size_t>(phase[corner])].name;
  return text;
}

/** Fraction of the last phase in up to four slices across each axis. */
std::vector<std::string> slice_lines(const VoxelMorphology &cells,
                                     const MPI_Comm communicator)
{
  std::vector<std::string> lines;
  const auto &n              = cells.grid.cells;
  const std::uint8_t counted = cells.phases.size() - 1;
  const std::size_t first =
    own_planes(n[2], communicator).first * cells.grid.cells_in_layer();
  std::size_t stride = 1;
  for (unsigned int d = 0; d < 3; ++d)
    {
      const unsigned int n_slices = std::min(4U, n[d]);
      std::vector<double> all(n_slices, 0.), part(n_slices, 0.);
      for (std::size_t k = 0; k < cells.phase_id.size(); ++k)
        {
          const std::size_t slice = (first + k) / stride % n[d] * n_slices / n[d];
          all[slice] += 1.;
          part[slice] += cells.phase_id[k] == counted ? 1. : 0.;
        }
      sum_over_ranks(all, communicator);
      sum_over_ranks(part, communicator);
      std::string line = "Slices across " + std::string(1, "xyz"[d]) +
                         ", from below: " + cells.phases[counted].name;
      for (unsigned int s = 0; s < n_slices; ++s)
        line += (s == 0 ? " " : ", ") + percent_text(part[s] / all[s]);
      lines.push_back(line);
      stride *= n[d];
    }
  return lines;
}

void describe_phases(VoxelMorphology &result,
                     const std::vector<PhaseParameters> &phases,
                     const MPI_Comm communicator)
{
  std::vector<double> count(phases.size(), 0.);
  for (const std::uint8_t id : result.phase_id)
    count[id] += 1.;
  sum_over_ranks(count, communicator);
  const auto n = static_cast<double>(result.grid.n_cells());
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      result.fractions.push_back(count[p] / n);
      result.description.push_back("Phase " + std::to_string(p) + ", " + phases[p].name +
                                   ": " + std::to_string(std::llround(count[p])) +
                                   " cells, " + percent_text(result.fractions[p]) + "; " +
                                   phases[p].text<3>());
      if (count[p] == 0.)
        result.warnings.push_back("phase '" + phases[p].name +
                                  "' of Phases/Names fills no cell of the morphology; "
                                  "mend what tells the phases apart, or leave its "
                                  "name out");
    }
}
/** Places the inclusions, or throws if there is no room. */
void place_inclusions(VoxelMorphology &result,
                      const MicrostructureParameters &p,
                      const MPI_Comm communicator)
{
  const InclusionPlacement &rules = p.inclusions;
  InclusionMorphology placed      = place_random_inclusions(
         p.box, rules, static_cast<std::uint8_t>(p.fibre_phase_index()), communicator);
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
  result.phase_id = std::move(placed.map.id);
}

/** Reads the file of voxels. */
void read_voxels(VoxelMorphology &result,
                 const MicrostructureParameters &p,
                 const MPI_Comm communicator)
{
  std::unique_ptr<VoxelFile> file;
  VoxelRegion region;
  on_all_ranks(communicator, [&]() {
    file   = VoxelFile::open(p.voxels.source(p.file));
    region = region_of_voxels(p, file->shape());
  });
  CellPhases cells   = read_cell_phases(p, *file, region, communicator);
  result.phase_id    = std::move(cells.id);
  const auto numbers = [](const std::array<std::size_t, 3> &n) {
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
  describe_phases(result, p.phases, communicator);
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
void read_orientations(VoxelMorphology &result,
                       const MicrostructureParameters &p,
                       const MPI_Comm communicator)
{
  if (p.orientation.file.empty())
    return;
  CellOrientations found =
    read_cell_orientations(p, result.phase_id, result.phases, communicator);
  result.orientations = std::move(found.orientations);
  for (const std::string &line : found.description)
    result.description.push_back(line);
  for (const std::string &warning : found.warnings)
    result.warnings.push_back(warning);
}

void describe_places(VoxelMorphology &result, const MPI_Comm communicator)
{
  result.description.push_back(corners_line(result, communicator));
  for (const std::string &line : slice_lines(result, communicator))
    result.description.push_back(line);
}
} // namespace

VoxelMorphology make_voxels(const MicrostructureParameters &parameters,
                            const MPI_Comm communicator)
{
  using Type = MicrostructureParameters::Type;
  VoxelMorphology result;
  const UniformGrid<3> &grid = parameters.box;
  result.grid                = grid;
  result.phases              = make_phases<3>(parameters.phases);
  result.description         = {"Grid: " + voxel_numbers(grid.cells) + " cells of " +
                                brief_text(4, grid.spacing[0], " x ", grid.spacing[1], " x ",
                                           grid.spacing[2], " m, ", grid.extent(0), " x ",
                                           grid.extent(1), " x ", grid.extent(2), " m")};
  if (parameters.type == Type::homogeneous)
    {
      result.phase_id.assign(
        own_planes(grid.cells[2], communicator).count * grid.cells_in_layer(), 0);
      result.description.emplace_back("Morphology: homogeneous");
      describe_phases(result, parameters.phases, communicator);
      result.warnings.clear();
      read_orientations(result, parameters, communicator);
      return result;
    }
  if (parameters.type == Type::random_inclusions)
    {
      place_inclusions(result, parameters, communicator);
      describe_phases(result, parameters.phases, communicator);
    }
  else
    read_voxels(result, parameters, communicator);
  describe_places(result, communicator);
  read_orientations(result, parameters, communicator);
  return result;
}
} // namespace mesoslip
