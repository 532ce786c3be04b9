#include "morphology/orientations/orientation_reading.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "grid/cell_planes.h"
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
/** Round-off leaves larger angles, numbers with a wrong byte order smaller ones
 * (degrees). */
constexpr double smallest_angle = 1e-25;
/** A file without larger angles is likely to have radians (degrees). */
constexpr double full_turn_in_radians = 6.2832;

/** "[2][0][7]" for a voxel of the file. */
std::string voxel_text(const std::array<std::size_t, 3> &xyz)
{
  return "voxel [" + std::to_string(xyz[2]) + "][" + std::to_string(xyz[1]) + "][" +
         std::to_string(xyz[0]) + "]";
}

/** Voxels of this rank's cells. */
VoxelRegion region_of_cells(const MicrostructureParameters &p,
                            const MPI_Comm communicator)
{
  const auto n            = voxels_of(p);
  VoxelRegion region      = p.type == MicrostructureParameters::Type::voxels
                              ? region_of_voxels(p, {n[2], n[1], n[0]})
                              : VoxelRegion{{}, n};
  const PlaneRange planes = own_planes(p.box.cells[2], communicator);
  region.from[2] += planes.first;
  region.size[2] = planes.count;
  return region;
}

/** Makes the set on each rank the union over all ranks. Collective. */
template <typename T>
void unite(std::set<T> &elements, const MPI_Comm communicator)
{
  const std::vector<T> own(elements.begin(), elements.end());
  for (const auto &some : mpi::all_gather(own, communicator))
    elements.insert(some.begin(), some.end());
}

/** Reads the angles or grains of the cells of this rank. */
class OrientationReader
{
public:
  OrientationReader(const MicrostructureParameters &p,
                    const std::vector<bool> &turns,
                    const MPI_Comm communicator)
    : p(p)
    , reading(p.orientation)
    , turns(turns)
    , has_grains(!reading.table.empty())
    , region(region_of_cells(p, communicator))
    , palette(reading.step)
  {
  }

  /** Reads orientations for cells with these phases. */
  void read(const std::vector<std::uint8_t> &phase_id)
  {
    if (has_grains)
      grains = read_grains(reading.table);
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
  }

  /** Numbers the pairs of all ranks in the order of the cells, independent of the number
   * of ranks. Collective. */
  void share(const MPI_Comm communicator)
  {
    unite(seen, communicator);
    unite(found_grains, communicator);
    largest   = mpi::max(largest, communicator);
    deviation = mpi::max(palette.deviation(), communicator);
    Palette all(0.); // angles are rounded already
    std::vector<std::size_t> number;
    const auto of_ranks = mpi::all_gather(palette.materials(), communicator);
    for (unsigned int r = 0; r < of_ranks.size(); ++r)
      for (const OrientedPhase &pair : of_ranks[r])
        {
          const std::size_t k = all.add(pair.phase, pair.euler_angles);
          if (r == mpi::this_mpi_process(communicator))
            number.push_back(k);
        }
    for (unsigned int phase = 0; phase < turns.size(); ++phase)
      if (!seen.count(phase))
        all.add(phase, {});
    if (all.size() > Orientations::most_materials)
      refuse_number(all.size());
    for (std::uint16_t &material : id)
      material = static_cast<std::uint16_t>(number[material]);
    materials = all.materials();
  }

  std::vector<std::uint16_t> id;        ///< per cell of this rank
  std::vector<OrientedPhase> materials; ///< materials of all cells
  std::set<double> found_grains;        ///< grains of cells with anisotropic phases
  double largest   = 0.;                ///< angle of a cell (degrees), without its sign
  double deviation = 0.; ///< largest angle (degrees) by which rounding turns a cell

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

  [[noreturn]] void refuse_number(const std::size_t n) const
  {
    throw UserError(
      reading.file + " makes " +
      (n >= Palette::most_seen ? "a million or more" : std::to_string(n)) +
      " different pairs of phase and orientation, and there may be up to " +
      std::to_string(Orientations::most_materials) + "; " +
      (reading.step > 0. ? "increase " : "set ") +
      "Microstructure/Orientation step, which rounds the angles, such as to " +
      (reading.step > 0. ? to_text(2. * reading.step) : std::string("10")) + " degrees");
  }

  const MicrostructureParameters &p;
  const OrientationReading &reading;
  const std::vector<bool> turns; ///< per phase: whether it is anisotropic
  const bool has_grains;
  const VoxelRegion region;
  std::map<double, Angles> grains;
  std::set<unsigned int> seen; ///< phases with cells
  unsigned int last_phase   = 0;
  Angles last_angles        = {};
  std::uint16_t last_number = 0;
  Palette palette; ///< materials of this rank's cells
};

/** The file that has the angles. */
std::string reading_name(const MicrostructureParameters &p)
{
  const OrientationReading &reading = p.orientation;
  return std::filesystem::path(reading.table.empty() ? reading.file : reading.table)
    .filename()
    .string();
}

std::vector<std::string> description_of(const OrientationReader &cells,
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
  text += ", " + std::to_string(cells.materials.size()) +
          " different pairs of phase and orientation";
  if (reading.step > 0.)
    text +=
      brief_text(4, "; angles rounded to ", reading.step,
                 " degrees, which turns a cell by up to ", cells.deviation, " degrees");
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
                                        const std::vector<Phase<3>> &phases,
                                        const MPI_Comm communicator)
{
  const std::vector<bool> turns = phases_that_turn(phases);
  OrientationReader cells(p, turns, communicator);
  on_all_ranks(communicator, [&]() { cells.read(phase_id); });
  cells.share(communicator);
  CellOrientations result;
  result.description = description_of(cells, p, turns);
  if (cells.largest > 0. && cells.largest <= full_turn_in_radians)
    result.warnings.push_back(
      brief_text(4, "No angle of ", reading_name(p), " is larger than ", cells.largest,
                 " degrees: are they radians? They have to be degrees"));
  std::vector<double> &fractions = result.orientations.fractions;
  fractions.assign(cells.materials.size(), 0.);
  for (const std::uint16_t material : cells.id)
    fractions[material] += 1.;
  sum_over_ranks(fractions, communicator);
  for (double &fraction : fractions)
    fraction /= static_cast<double>(p.box.n_cells());
  result.orientations.materials = std::move(cells.materials);
  result.orientations.id        = std::move(cells.id);
  return result;
}
} // namespace mesoslip
