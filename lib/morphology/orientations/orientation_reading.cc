#include "morphology/orientations/orientation_reading.h"

#include "base/errors.h"
#include "material/plausibility.h"
#include "morphology/microstructure_parameters.h"
#include "morphology/orientations/palette.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace mesoslip
{
namespace
{
/** Round-off leaves more, numbers whose bytes are read in the wrong order less (degrees). */
constexpr double smallest_angle = 1e-25;
/** A file without a larger angle is likely to have radians (degrees). */
constexpr double full_turn_in_radians = 6.2832;

/** "[2][0][7]" of a voxel of the file. */
std::string voxel_text(const std::array<std::size_t, 3> &xyz)
{
  return "voxel [" + std::to_string(xyz[2]) + "][" + std::to_string(xyz[1]) + "][" +
         std::to_string(xyz[0]) + "]";
}

/** The voxels that are cells. */
VoxelRegion region_of_cells(const MicrostructureParameters &p)
{
  const auto n = voxels_of(p);
  return p.type == MicrostructureParameters::Type::voxels
           ? region_of_voxels(p, {n[2], n[1], n[0]})
           : VoxelRegion{{}, n};
}

/** Reads the angles or grains of the cells and fills the palette. */
class CellReader
{
public:
  CellReader(const MicrostructureParameters &p, const std::vector<bool> &turns)
    : p(p)
    , reading(p.orientation)
    , turns(turns)
    , has_grains(!reading.table.empty())
    , region(region_of_cells(p))
    , palette(reading.step)
  {
    if (has_grains)
      grains = read_grains(reading.table);
  }

  void read(const std::vector<std::uint8_t> &phase_id)
  {
    const auto n    = voxels_of(p);
    const auto file = VoxelFile::open(reading.source(n));
    id.reserve(phase_id.size());
    for (std::size_t z = 0; z < region.size[2]; ++z)
      {
        const std::vector<double> plane = file->plane(region.from[2] + z);
        for (std::size_t y = 0; y < region.size[1]; ++y)
          for (std::size_t x = 0; x < region.size[0]; ++x)
            {
              const std::size_t at =
                ((region.from[1] + y) * n[0] + region.from[0] + x) * n_components();
              add_cell(phase_id[id.size()], &plane[at],
                       {{region.from[0] + x, region.from[1] + y, region.from[2] + z}});
            }
      }
    for (unsigned int phase = 0; phase < turns.size(); ++phase)
      if (!seen.count(phase))
        palette.add(phase, {});
    if (palette.size() > Orientations::most_materials)
      refuse_number();
  }

  std::vector<std::uint16_t> id; ///< of the cells
  std::set<double> found_grains; ///< that cells have which turn
  double largest = 0.;           ///< angle of a cell (degrees), without its sign

private:
  std::size_t n_components() const
  {
    return has_grains ? 1 : 3;
  }

  void add_cell(const unsigned int phase,
                const double *numbers,
                const std::array<std::size_t, 3> &voxel)
  {
    Angles angles = {};
    if (turns[phase])
      angles = has_grains ? angles_of_grain(numbers[0], voxel)
                          : checked({{numbers[0], numbers[1], numbers[2]}}, voxel);
    if (id.empty() || phase != last_phase || angles != last_angles)
      {
        last_number = static_cast<std::uint16_t>(palette.add(phase, angles));
        last_phase  = phase;
        last_angles = angles;
        seen.insert(phase);
        for (const double angle : angles)
          largest = std::max(largest, std::abs(angle));
      }
    id.push_back(last_number);
  }

  Angles angles_of_grain(const double grain, const std::array<std::size_t, 3> &voxel)
  {
    const auto found = grains.find(grain);
    if (found == grains.end())
      throw UserError(reading.file + ": " + voxel_text(voxel) + " is of grain " +
                      to_text(grain) + ", which has no line in " + reading.table +
                      "; add its angles");
    found_grains.insert(grain);
    return found->second;
  }

  Angles checked(const Angles &angles, const std::array<std::size_t, 3> &voxel) const
  {
    for (const double angle : angles)
      if (!std::isfinite(angle))
        throw UserError(reading.file + ": " + voxel_text(voxel) +
                        " has an angle that is nan or infinity; save numbers for all "
                        "voxels of anisotropic phases");
      else if (std::abs(angle) > largest_bunge_angle ||
               (angle != 0. && std::abs(angle) < smallest_angle))
        throw UserError(reading.file + ": " + voxel_text(voxel) + " has the angle " +
                        to_text(angle) + " degrees, where two turns are 720; check " +
                        (has_ending(reading.file, ".raw")
                           ? "Orientation raw type and Orientation raw byte order"
                           : "what the file holds"));
    return angles;
  }

  [[noreturn]] void refuse_number() const
  {
    throw UserError(
      reading.file + " makes " +
      (palette.size() >= Palette::most_seen ? "a million or more"
                                            : std::to_string(palette.size())) +
      " different pairs of phase and orientation, and there may be up to " +
      std::to_string(Orientations::most_materials) + "; " +
      (reading.step > 0. ? "increase " : "set ") +
      "Microstructure/Orientation step, which rounds the angles, such as to " +
      (reading.step > 0. ? to_text(2. * reading.step) : std::string("10")) + " degrees");
  }

  const MicrostructureParameters &p;
  const OrientationReading &reading;
  const std::vector<bool> turns; ///< of each phase, whether it is anisotropic
  const bool has_grains;
  const VoxelRegion region;
  std::map<double, Angles> grains;
  std::set<unsigned int> seen; ///< phases with cells
  unsigned int last_phase   = 0;
  Angles last_angles        = {};
  std::uint16_t last_number = 0;

public:
  Palette palette;
};

/** The file that has the angles. */
std::string reading_name(const MicrostructureParameters &p)
{
  const OrientationReading &reading = p.orientation;
  return std::filesystem::path(reading.table.empty() ? reading.file : reading.table)
    .filename()
    .string();
}

std::vector<std::string> description_of(const CellReader &cells,
                                        const MicrostructureParameters &p,
                                        const std::vector<bool> &turns)
{
  const OrientationReading &reading = p.orientation;
  std::string text                  = "Orientations: ";
  if (reading.table.empty())
    text += "angles of " + std::filesystem::path(reading.file).filename().string();
  else
    text += std::to_string(cells.found_grains.size()) + " grains of " +
            std::filesystem::path(reading.file).filename().string() +
            " with the angles of " +
            std::filesystem::path(reading.table).filename().string();
  text += ", " + std::to_string(cells.palette.size()) +
          " different pairs of phase and orientation";
  if (reading.step > 0.)
    text += brief_text(4, "; angles rounded to ", reading.step,
                       " degrees, which turns a cell by up to ",
                       cells.palette.deviation(), " degrees");
  std::vector<std::string> lines = {text};
  std::vector<std::string> ignored, twice;
  for (std::size_t k = 0; k < turns.size(); ++k)
    if (!turns[k])
      ignored.push_back(p.phases[k].name);
    else if (p.phases[k].is_turned_in_3d() || p.phases[k].angle != 0.)
      twice.push_back(p.phases[k].name);
  if (!ignored.empty())
    lines.push_back("Orientations of isotropic phases do not count: " + to_text(ignored));
  if (!twice.empty())
    lines.push_back("Phases that their own keys turn before the cells are turned: " +
                    to_text(twice));
  return lines;
}
} // namespace

CellOrientations read_cell_orientations(const MicrostructureParameters &p,
                                        const std::vector<std::uint8_t> &phase_id,
                                        const std::vector<Phase<3>> &phases)
{
  const std::vector<bool> turns = phases_that_turn(phases);
  CellReader cells(p, turns);
  cells.read(phase_id);
  CellOrientations result;
  result.description = description_of(cells, p, turns);
  if (cells.largest > 0. && cells.largest <= full_turn_in_radians)
    result.warnings.push_back(
      brief_text(4, "No angle of ", reading_name(p), " is larger than ", cells.largest,
                 " degrees: are they radians? They have to be degrees"));
  result.orientations.materials = cells.palette.materials();
  result.orientations.id        = std::move(cells.id);
  return result;
}
} // namespace mesoslip
