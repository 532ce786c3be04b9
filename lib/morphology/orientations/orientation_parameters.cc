#include "base/errors.h"
#include "io/table.h"
#include "morphology/microstructure_parameters.h"
#include "morphology/orientations/orientation_reading.h"
#include "parameters/keys.h"
#include "program/output_folder.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
const std::string of_section = "Microstructure/";
} // namespace

std::array<std::size_t, 3> voxels_of(const MicrostructureParameters &p)
{
  if (p.type == MicrostructureParameters::Type::voxels)
    {
      const auto shape = VoxelFile::open(p.voxels.source(p.file))->shape();
      return {{shape[2], shape[1], shape[0]}};
    }
  return {{p.box.cells[0], p.box.cells[1], p.box.cells[2]}};
}

std::map<double, std::array<double, 3>> read_grains(const std::string &path)
{
  const CsvTable table = CsvTable::read(path);
  const auto grain     = table.numbers("grain");
  const auto phi_1     = table.numbers("phi1 [degrees]"),
             Phi       = table.numbers("Phi [degrees]"),
             phi_2     = table.numbers("phi2 [degrees]");
  std::map<double, std::array<double, 3>> grains;
  for (std::size_t row = 0; row < grain.size(); ++row)
    {
      const std::array<double, 3> angles = {{phi_1[row], Phi[row], phi_2[row]}};
      for (const double angle : angles)
        if (!(std::abs(angle) <= largest_bunge_angle))
          table.fail(row, "the angle " + to_text(angle) +
                            " degrees is beyond two turns, 720; write angles in degrees");
      if (grain[row] != std::floor(grain[row]))
        table.fail(row, "grain " + to_text(grain[row]) + " is no whole number");
      if (!grains.emplace(grain[row], angles).second)
        table.fail(row,
                   "grain " + to_text(grain[row]) + " stands in two lines; remove one");
    }
  return grains;
}

std::vector<bool> phases_that_turn(const std::vector<Phase<3>> &phases)
{
  std::vector<bool> turns;
  for (const Phase<3> &phase : phases)
    {
      // The part of the thermal stress without a preferred axis is isotropic.
      VoigtVector<3> rest = phase.thermal_stress;
      rest.head<3>().array() -= phase.thermal_stress.head<3>().mean();
      turns.push_back(!is_isotropic(phase.stiffness) ||
                      rest.cwiseAbs().maxCoeff() >
                        1e-12 * phase.thermal_stress.cwiseAbs().maxCoeff());
    }
  return turns;
}

void OrientationReading::bind(Keys &keys)
{
  keys.bind_input(
    "Orientation file", file,
    "3D: orientation of each voxel, for phases that are not isotropic: Bunge's "
    "angles phi1, Phi, phi2 in degrees, an array [z][y][x][3], which turn what "
    "the keys of the phase say; with Orientation table the number of the "
    "grain, [z][y][x]. .npy, .raw or .h5 [-]");
  keys.bind_input(
    "Orientation table", table,
    "Angles of the grains of Orientation file: CSV with the columns grain, phi1 "
    "[degrees], Phi [degrees], phi2 [degrees]. Empty: the file has angles [-]");
  keys.bind("Orientation dataset", dataset,
            "Orientation file in HDF5: path of the dataset in the file [-]");
  keys.bind("Orientation raw type", raw_type, number_type_names(),
            "Orientation file that is a .raw: type of the numbers [-]");
  keys.bind("Orientation raw byte order", raw_big_endian, {"little", "big"},
            "Orientation file that is a .raw: which end of a number comes first: little: "
            "the lowest byte, as on PCs; big: the highest [-]");
  keys.bind(
    "Orientation step", step, Range::closed(0., 90.),
    "Angles of Orientation file are rounded to multiples of it, so that there are "
    "fewer different ones; 0: they are not [degrees]");
  keys.only_if(!file.empty(),
               {"Orientation table", "Orientation dataset", "Orientation raw type",
                "Orientation raw byte order", "Orientation step"},
               "Microstructure/Orientation file is empty", "name one");
  keys.only_if(
    has_ending(file, ".raw"), {"Orientation raw type", "Orientation raw byte order"},
    "Microstructure/Orientation file does not end in .raw", "name such a file");
  keys.only_if(is_hdf5_name(file), {"Orientation dataset"},
               "Microstructure/Orientation file does not end in .h5, .hdf5, .dream3d, "
               ".mat or .nc",
               "name such a file");
}

VoxelSource OrientationReading::source(const std::array<std::size_t, 3> &voxels) const
{
  VoxelSource source;
  source.path        = file;
  source.dataset     = dataset;
  source.raw_type    = number_type(raw_type, raw_big_endian);
  source.raw_shape   = voxels;
  source.components  = table.empty() ? 3 : 1;
  source.dataset_key = of_section + "Orientation dataset";
  source.raw_keys    = of_section + "Orientation raw type and Orientation raw byte order";
  return source;
}

void check_orientations(const MicrostructureParameters &p)
{
  const OrientationReading &reading = p.orientation;
  const std::string key             = of_section + "Orientation file: ";
  if (p.dim != 3)
    throw UserError(key + "it needs Dimension = 3; remove it");
  require_readable_file(key, reading.file, "it has to name an array, such as a .npy");
  const auto turns = phases_that_turn(make_phases<3>(p.phases));
  for (std::size_t k = 0; k < turns.size(); ++k)
    if (!turns[k] && p.phases[k].conducts_along_axes())
      throw UserError(
        key + "it turns phases by their stiffness and expansion, which phase " +
        p.phases[k].name +
        " has the same along all axes, but not its Conductivity; give that as "
        "one number");
  if (std::none_of(turns.begin(), turns.end(), [](const bool turn) { return turn; }))
    throw UserError(key +
                    "all phases are isotropic, so that orientations change nothing; "
                    "remove it, or give a phase Type = orthotropic or stiffness");
  if (p.type == MicrostructureParameters::Type::voxels && p.voxels.coarsening != 1)
    throw UserError(of_section + "Coarsening is " + std::to_string(p.voxels.coarsening) +
                    ", but with Orientation file a voxel is a cell; set it to 1 and make "
                    "coarser files");
  const auto n             = voxels_of(p);
  const VoxelSource source = reading.source(n);
  if (source.kind() == VoxelSource::Kind::stack)
    throw UserError(reading.file +
                    " is a picture or a stack of pictures, but orientations "
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
  require_readable_file(of_section + "Orientation table: ", reading.table,
                        "it has to name a CSV file");
  if (!file->is_whole())
    throw UserError(reading.file + " holds numbers of the type " + file->type_text() +
                    ", but grains are whole numbers; save it as int32, or remove "
                    "Orientation table if these are angles");
  read_grains(reading.table);
}
} // namespace mesoslip
