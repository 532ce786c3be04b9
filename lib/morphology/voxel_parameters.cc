#include "base/errors.h"
#include "morphology/microstructure_parameters.h"
#include "morphology/voxels.h"
#include "parameters/keys.h"

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
void bind_raw(Keys &keys, VoxelReading &reading, const std::string &path)
{
  constexpr long most = 1000000;
  keys.bind("Dataset", reading.dataset,
            "Voxels in HDF5: path of the dataset [z][y][x] in the file [-]");
  keys.bind_list("Raw shape", reading.raw_shape, 1, most,
                 "Voxels in a .raw: their numbers along x, y and z; in the file x is the "
                 "fastest, then y [-]",
                 0, 3);
  keys.bind("Raw type", reading.raw_type, number_type_names(),
            "Voxels in a .raw: type of the numbers [-]");
  keys.bind(
    "Raw byte order", reading.raw_big_endian, {"little", "big"},
    "Voxels in a .raw: which end of a number comes first: little: the lowest byte, "
    "as on PCs; big: the highest [-]");
  keys.require(reading.raw_shape.size() % 3 == 0, "Raw shape",
               "there are " + std::to_string(reading.raw_shape.size()) +
                 " numbers; give three, along x, y and z");
  keys.only_if(has_ending(path, ".raw"), {"Raw shape", "Raw type", "Raw byte order"},
               "Microstructure/File does not end in .raw", "name such a file");
  keys.only_if(is_hdf5_name(path), {"Dataset"},
               "Microstructure/File does not end in .h5, .hdf5, .dream3d, .mat or .nc",
               "name such a file");
}

std::string numbers_list(const std::array<std::size_t, 3> &n)
{
  return std::to_string(n[0]) + ", " + std::to_string(n[1]) + ", " + std::to_string(n[2]);
}
} // namespace

void VoxelReading::bind(Keys &keys, const std::string &path)
{
  constexpr long most = 1000000;
  keys.bind_list("Crop from", crop_from, 0, most,
                 "Voxels: the first one that is taken along x, y and z, counted from 0. "
                 "Empty: 0, 0, 0 [-]",
                 0, 3);
  keys.bind_list(
    "Crop size", crop_size, 1, most,
    "Voxels: how many are taken along x, y and z. Empty: all from Crop from on "
    "[-]",
    0, 3);
  keys.bind(
    "Coarsening", coarsening, 1, 1000,
    "Voxels of an edge of a cell: a cell of n x n x n voxels takes the phase that "
    "most of them have; where several have as many, the one furthest below its "
    "share so far [-]");
  bind_raw(keys, *this, path);
  keys.only_with("Type", {"voxels"}, {"Crop from", "Crop size", "Coarsening"});
  for (const auto &[key, list] :
       {std::pair("Crop from", &crop_from), std::pair("Crop size", &crop_size)})
    keys.require(list->size() % 3 == 0, key,
                 "there are " + std::to_string(list->size()) +
                   " numbers; give three, along x, y and z");
}

VoxelSource VoxelReading::source(const std::string &path) const
{
  VoxelSource source;
  source.path     = path;
  source.dataset  = dataset;
  source.raw_type = number_type(raw_type, raw_big_endian);
  std::copy(raw_shape.begin(), raw_shape.end(), source.raw_shape.begin());
  return source;
}

VoxelRegion region_of_voxels(const MicrostructureParameters &p,
                             const std::vector<std::size_t> &shape)
{
  const VoxelReading &reading          = p.voxels;
  const std::array<std::size_t, 3> has = {{shape[2], shape[1], shape[0]}};
  const std::string array = p.file + ", an array [" + std::to_string(shape[0]) + "][" +
                            std::to_string(shape[1]) + "][" + std::to_string(shape[2]) +
                            "] in the order [z][y][x]";
  if (has[0] * has[1] * has[2] == 0)
    throw UserError(array + ", has no voxels; save it again");
  VoxelRegion region;
  std::array<std::size_t, 3> cells = {}, whole = {};
  const std::size_t n = reading.coarsening;
  for (unsigned int d = 0; d < 3; ++d)
    {
      if (!reading.crop_from.empty())
        region.from[d] = static_cast<std::size_t>(reading.crop_from[d]);
      const std::size_t left = has[d] > region.from[d] ? has[d] - region.from[d] : 0;
      region.size[d] =
        reading.crop_size.empty() ? left : static_cast<std::size_t>(reading.crop_size[d]);
      if (region.size[d] == 0 || region.size[d] > left)
        throw UserError(
          "Microstructure/Crop " +
          (left == 0 ? "from: voxel "
                     : "size: " + std::to_string(region.size[d]) + " voxels from ") +
          std::to_string(region.from[d]) + (left == 0 ? "" : " on") + " along " +
          "xyz"[d] + (left == 0 ? " does" : " do") + " not lie in " + array +
          "; reduce it");
      cells[d] = region.size[d] / n;
      whole[d] = cells[d] * n;
    }
  if (whole != region.size)
    throw UserError(
      "Microstructure/Coarsening: " + numbers_list(region.size) +
      " voxels are no whole cells of " + std::to_string(n) + " voxels an edge; " +
      (cells[0] * cells[1] * cells[2] == 0 ? "reduce it"
                                           : "set Crop size = " + numbers_list(whole)));
  if (!std::equal(cells.begin(), cells.end(), p.box.cells.begin()))
    {
      const bool all = region.size == has && n == 1;
      const auto &in = p.box.cells;
      std::string other;
      if (!reading.raw_shape.empty())
        other = "mend Microstructure/Raw shape, the numbers along x, y and z, or ";
      else if (cells[0] == in[2] && cells[1] == in[1] && cells[2] == in[0])
        other = "save the array with its axes the other way round, or ";
      else if (cells[0] == in[0] && cells[1] == in[1] &&
               reading.source(p.file).kind() == VoxelSource::Kind::stack)
        other = "look whether pictures are missing or too many, or ";
      throw UserError(
        "Grid/Cells: " +
        to_text(std::vector<std::string>{
          numbers_list({{p.box.cells[0], p.box.cells[1], p.box.cells[2]}})}) +
        " cells do not fit " + array +
        (all ? ""
             : ", of which Crop and Coarsening leave " + numbers_list(cells) + " cells") +
        "; " + other + "set Grid/Cells = " + numbers_list(cells));
    }
  return region;
}

void check_voxels(const MicrostructureParameters &p)
{
  const VoxelReading &reading = p.voxels;
  const VoxelSource source    = reading.source(p.file);
  if (p.phases.size() > 256)
    throw UserError("Phases/Names: there may be up to 256 phases of voxels");
  if (p.file.empty() || source.kind() != VoxelSource::Kind::stack)
    require_readable_file("Microstructure/File: ", p.file,
                          "it has to name an array of voxels, such as a .npy");
  const auto file = VoxelFile::open(source);
  if (!file->is_whole() && p.image.thresholds.empty())
    throw UserError(p.file + " holds numbers of the type " + file->type_text() +
                    ", but phases are whole numbers; save it as uint8, or set "
                    "Microstructure/Thresholds");
  region_of_voxels(p, file->shape());
}
} // namespace mesoslip
