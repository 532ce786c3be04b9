#include "morphology/orientation_reading.h"

#include "base/errors.h"
#include "base/text.h"
#include "io/table.h"
#include "morphology/microstructure_parameters.h"
#include "parameters/keys.h"
#include "program/output_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

namespace mesoslip
{
namespace
{
using Angles = std::array<double, 3>;

const std::string section      = "Microstructure/";
constexpr std::size_t most_seen = 1000000; ///< different materials that are counted

/** "[2][0][7]" of a voxel of the file. */
std::string voxel_text(const std::array<std::size_t, 3> &xyz)
{
  return "voxel [" + std::to_string(xyz[2]) + "][" + std::to_string(xyz[1]) + "][" +
         std::to_string(xyz[0]) + "]";
}

std::string name_of(const std::string &path)
{
  return std::filesystem::path(path).filename().string();
}

/** Numbers of voxels along x, y, z of the file of voxels; without one those of cells. */
std::array<std::size_t, 3> voxels_of(const MicrostructureParameters &p)
{
  if (p.type == MicrostructureParameters::Type::voxels)
    {
      const auto shape = VoxelFile::open(p.voxels.source(p.file))->shape();
      return {{shape[2], shape[1], shape[0]}};
    }
  return {{p.box.cells[0], p.box.cells[1], p.box.cells[2]}};
}

/** The voxels that are cells. */
VoxelRegion region_of_cells(const MicrostructureParameters &p)
{
  const auto n = voxels_of(p);
  return p.type == MicrostructureParameters::Type::voxels
           ? region_of_voxels(p, {n[2], n[1], n[0]})
           : VoxelRegion{{}, n};
}

/** Angles (degrees) by number of grain. */
std::map<double, Angles> read_grains(const std::string &path)
{
  const CsvTable table = CsvTable::read(path);
  const auto grain     = table.numbers("grain");
  const auto phi_1     = table.numbers("phi1 [degrees]"),
             Phi       = table.numbers("Phi [degrees]"),
             phi_2     = table.numbers("phi2 [degrees]");
  std::map<double, Angles> grains;
  for (std::size_t row = 0; row < grain.size(); ++row)
    if (!grains.emplace(grain[row], Angles{{phi_1[row], Phi[row], phi_2[row]}}).second)
      table.fail(row, "grain " + to_text(grain[row]) + " stands in two lines; remove one");
  return grains;
}

Eigen::Matrix3d rotation_of(const Angles &angles)
{
  const double degree = M_PI / 180.;
  return bunge_rotation(degree * angles[0], degree * angles[1], degree * angles[2]);
}

/** Angle (degrees) between two orientations; exact also where it is small. */
double angle_between(const Angles &a, const Angles &b)
{
  const double chord = (rotation_of(a) - rotation_of(b)).norm() / std::sqrt(8.);
  return 360. / M_PI * std::asin(std::min(1., chord));
}

/** Gives each distinct pair of phase and orientation a number. */
class Palette
{
public:
  explicit Palette(const double step)
    : step(step)
  {
  }

  std::size_t add(const unsigned int phase, const Angles &given)
  {
    Angles angles = given;
    if (step > 0.)
      {
        for (unsigned int a = 0; a < 3; ++a)
          {
            const double n = std::round(given[a] / step);
            angles[a]      = n * step;
          }
        // Turns by 360 degrees are none.
        for (const unsigned int a : {0U, 2U})
          angles[a] -= 360. * std::floor(angles[a] / 360.);
        deviation = std::max(deviation, angle_between(given, angles));
      }
    for (double &angle : angles)
      angle += 0.; // no -0
    if (numbers.size() >= most_seen)
      return 0;
    return numbers.emplace(std::make_pair(phase, angles), numbers.size()).first->second;
  }

  std::size_t size() const
  {
    return numbers.size();
  }

  std::vector<OrientedPhase> materials() const
  {
    std::vector<OrientedPhase> result(numbers.size());
    for (const auto &[material, number] : numbers)
      result[number] = {material.first, material.second};
    return result;
  }

  const double step;
  double deviation = 0.; ///< largest angle (degrees) by which rounding has turned

private:
  std::map<std::pair<unsigned int, Angles>, std::size_t> numbers;
};

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
    return angles;
  }

  [[noreturn]] void refuse_number() const
  {
    throw UserError(
      reading.file + " makes " +
      (palette.size() >= most_seen ? "a million or more"
                                   : std::to_string(palette.size())) +
      " different pairs of phase and orientation, and there may be up to " +
      std::to_string(Orientations::most_materials) + "; " +
      (reading.step > 0. ? "increase " : "set ") + section +
      "Orientation step, which rounds the angles, such as to " +
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

/** Which phases are anisotropic. */
std::vector<bool> phases_that_turn(const std::vector<Phase<3>> &phases)
{
  std::vector<bool> turns;
  for (const Phase<3> &phase : phases)
    turns.push_back(!is_isotropic(phase.stiffness));
  return turns;
}

std::vector<std::string> description_of(const CellReader &cells,
                                        const MicrostructureParameters &p,
                                        const std::vector<bool> &turns)
{
  const OrientationReading &reading = p.orientation;
  std::string text                  = "Orientations: ";
  if (reading.table.empty())
    text += "angles of " + name_of(reading.file);
  else
    text += std::to_string(cells.found_grains.size()) + " grains of " +
            name_of(reading.file) + " with the angles of " + name_of(reading.table);
  text += ", " + std::to_string(cells.palette.size()) +
          " different pairs of phase and orientation";
  if (reading.step > 0.)
    text += brief_text(4, "; angles rounded to ", reading.step,
                       " degrees, which turns a cell by up to ", cells.palette.deviation,
                       " degrees");
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

void OrientationReading::bind(Keys &keys)
{
  keys.bind_input("Orientation file", file,
                  "3D: orientation of each voxel, for phases that are not isotropic: Bunge's "
                  "angles phi1, Phi, phi2 in degrees, an array [z][y][x][3], which turn what "
                  "the keys of the phase say; with Orientation table the number of the "
                  "grain, [z][y][x]. .npy, .raw or .h5 [-]");
  keys.bind_input("Orientation table", table,
                  "Angles of the grains of Orientation file: CSV with the columns grain, phi1 "
                  "[degrees], Phi [degrees], phi2 [degrees]. Empty: the file has angles [-]");
  keys.bind("Orientation dataset", dataset,
            "Orientation file in HDF5: path of the dataset in the file [-]");
  keys.bind("Orientation raw type", raw_type, number_type_names(),
            "Orientation file that is a .raw: type of the numbers, the lowest byte first [-]");
  keys.bind("Orientation step", step, Range::closed(0., 90.),
            "Angles of Orientation file are rounded to multiples of it, so that there are "
            "fewer different ones; 0: they are not [degrees]");
  keys.only_if(!file.empty(),
               {"Orientation table", "Orientation dataset", "Orientation raw type",
                "Orientation step"},
               "Microstructure/Orientation file is empty", "name one");
  keys.only_if(has_ending(file, ".raw"), {"Orientation raw type"},
               "Microstructure/Orientation file does not end in .raw", "name such a file");
  keys.only_if(has_ending(file, ".h5") || has_ending(file, ".hdf5"),
               {"Orientation dataset"},
               "Microstructure/Orientation file does not end in .h5 or .hdf5",
               "name such a file");
}

VoxelSource OrientationReading::source(const std::array<std::size_t, 3> &voxels) const
{
  VoxelSource source;
  source.path        = file;
  source.dataset     = dataset;
  source.raw_type    = number_type(raw_type, false);
  source.raw_shape   = voxels;
  source.components  = table.empty() ? 3 : 1;
  source.dataset_key = section + "Orientation dataset";
  source.raw_keys    = section + "Orientation raw type";
  return source;
}

void check_orientations(const MicrostructureParameters &p)
{
  const OrientationReading &reading = p.orientation;
  const std::string key             = section + "Orientation file: ";
  if (p.dim != 3)
    throw UserError(key + "it needs Dimension = 3; remove it");
  require_readable_file(key, reading.file, "it has to name an array, such as a .npy");
  const auto turns = phases_that_turn(make_phases<3>(p.phases));
  if (std::none_of(turns.begin(), turns.end(), [](const bool turn) { return turn; }))
    throw UserError(key + "all phases are isotropic, so that orientations change nothing; "
                          "remove it, or give a phase Type = orthotropic or stiffness");
  if (p.type == MicrostructureParameters::Type::voxels && p.voxels.coarsening != 1)
    throw UserError(section + "Coarsening is " + std::to_string(p.voxels.coarsening) +
                    ", but with Orientation file a voxel is a cell; set it to 1 and make "
                    "coarser files");
  const auto n             = voxels_of(p);
  const VoxelSource source = reading.source(n);
  if (source.kind() == VoxelSource::Kind::stack)
    throw UserError(reading.file + " is a picture or a stack of pictures, but orientations "
                                   "are read from .npy, .raw or .h5; save it as a .npy");
  const auto file   = VoxelFile::open(source);
  const auto &shape = file->shape();
  if (shape[0] != n[2] || shape[1] != n[1] || shape[2] != n[0])
    throw UserError(reading.file + " is an array [" + std::to_string(shape[0]) + "][" +
                    std::to_string(shape[1]) + "][" + std::to_string(shape[2]) +
                    "] of voxels, but those of the phases are [" + std::to_string(n[2]) +
                    "][" + std::to_string(n[1]) + "][" + std::to_string(n[0]) +
                    "], in the order [z][y][x]");
  if (reading.table.empty())
    return;
  require_readable_file(section + "Orientation table: ", reading.table,
                        "it has to name a CSV file");
  if (!file->is_whole())
    throw UserError(reading.file + " holds numbers of the type " + file->type_text() +
                    ", but grains are whole numbers; save it as int32, or remove "
                    "Orientation table if these are angles");
  read_grains(reading.table);
}

CellOrientations read_cell_orientations(const MicrostructureParameters &p,
                                        const std::vector<std::uint8_t> &phase_id,
                                        const std::vector<Phase<3>> &phases)
{
  const std::vector<bool> turns = phases_that_turn(phases);
  CellReader cells(p, turns);
  cells.read(phase_id);
  CellOrientations result;
  result.description            = description_of(cells, p, turns);
  result.orientations.materials = cells.palette.materials();
  result.orientations.id        = std::move(cells.id);
  return result;
}
} // namespace mesoslip
