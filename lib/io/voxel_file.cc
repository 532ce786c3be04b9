#include "io/voxel_file.h"

#include "base/errors.h"
#include "io/hdf5_file.h"
#include "io/numpy_array.h"

#include <boost/iostreams/device/mapped_file.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

std::string text_of_shape(const std::vector<std::size_t> &shape)
{
  return to_text(Shape(shape));
}

/** Contiguous numbers, with the last or the first axis fastest. */
class PlainVoxels : public VoxelFile
{
public:
  PlainVoxels(const std::string &path,
              const std::vector<std::size_t> &shape,
              const NumberType &type,
              const std::size_t offset,
              const bool first_fastest)
    : path(path)
    , type(type)
    , offset(offset)
    , first_fastest(first_fastest)
  {
    extents   = shape;
    whole     = type.is_whole();
    type_name = "'" + type.text() + "'";
  }

  std::vector<double> plane(const std::size_t z) override
  {
    const std::size_t n = plane_size();
    if (first_fastest)
      return scattered_plane(z);
    std::string bytes(n * type.bytes, '\0');
    if (!in.is_open())
      in.open(path, std::ios::binary);
    in.seekg(static_cast<std::streamoff>(offset + z * bytes.size()));
    if (!in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
      throw UserError(path + " cannot be read to its end; save it again");
    return type.decode(bytes.data(), n, path);
  }

private:
  /** Read from a memory map, as the numbers of a plane are scattered over the file. */
  std::vector<double> scattered_plane(const std::size_t z)
  {
    if (!all.is_open())
      map_file();
    std::string bytes(plane_size() * type.bytes, '\0');
    const std::size_t nc = extents.size() > 3 ? extents[3] : 1;
    std::size_t to       = 0;
    for (std::size_t y = 0; y < extents[1]; ++y)
      for (std::size_t x = 0; x < extents[2]; ++x)
        for (std::size_t c = 0; c < nc; ++c, to += type.bytes)
          std::copy_n(all.data() + offset +
                        (((c * extents[2] + x) * extents[1] + y) * extents[0] + z) *
                          type.bytes,
                      type.bytes, bytes.begin() + static_cast<std::ptrdiff_t>(to));
    return type.decode(bytes.data(), plane_size(), path);
  }

  void map_file()
  {
    try
      {
        all.open(path);
      }
    catch (const std::exception &)
      {
      }
    if (!all.is_open() || all.size() < offset + extents[0] * plane_size() * type.bytes)
      throw UserError(path + " cannot be read to its end; save it again");
  }

  const std::string path;
  const NumberType type;
  const std::size_t offset; ///< bytes in front of the numbers
  const bool first_fastest;
  std::ifstream in;
  boost::iostreams::mapped_file_source all; ///< if the first axis is the fastest
};

class Hdf5Voxels : public VoxelFile
{
public:
  explicit Hdf5Voxels(const VoxelSource &source)
    : file(Hdf5File::open(source.path))
    , dataset(source.dataset)
  {
    extents   = file.shape(dataset, source.dataset_key + " has to name one");
    stored    = extents;
    whole     = !file.is_floating(dataset);
    type_name = whole ? "'integer'" : "'float'";
  }

  std::vector<double> plane(const std::size_t z) override
  {
    Shape first(stored.size(), 0), count = stored;
    first[0]                   = z;
    count[0]                   = 1;
    std::vector<double> values = file.read_block<double>(dataset, first, count);
    if (whole)
      require_exact(values, file.path());
    return values;
  }

private:
  Hdf5File file;
  const std::string dataset;
  Shape stored; ///< extents of the dataset
};

std::unique_ptr<VoxelFile> open_raw(const VoxelSource &source)
{
  const auto &[nx, ny, nz] = source.raw_shape;
  if (nx == 0)
    throw UserError("Microstructure/Raw shape is empty; give the numbers of voxels of " +
                    source.path + " along x, y and z");
  const double needs = static_cast<double>(nx) * static_cast<double>(ny) *
                       static_cast<double>(nz) * source.components;
  std::error_code code;
  const std::uintmax_t has = fs::file_size(source.path, code);
  if (const double bytes = needs * source.raw_type.bytes;
      code || static_cast<double>(has) != bytes)
    throw UserError(source.path + " has " + std::to_string(code ? 0 : has) +
                    " bytes, not the " + to_text(bytes) + " of " + to_text(needs) +
                    " numbers of " + std::to_string(source.raw_type.bytes) +
                    " bytes; mend " + source.raw_keys);
  std::vector<std::size_t> shape = {nz, ny, nx};
  if (source.components > 1)
    shape.push_back(source.components);
  return std::make_unique<PlainVoxels>(source.path, shape, source.raw_type, 0, false);
}

std::unique_ptr<VoxelFile> open_numpy(const std::string &path)
{
  const NumpyHeader header = read_numpy_header(path);
  return std::make_unique<PlainVoxels>(path, header.shape, header.type, header.offset,
                                       header.fortran_order);
}
} // namespace

std::size_t VoxelFile::plane_size() const
{
  std::size_t n = 1;
  for (std::size_t axis = 1; axis < extents.size(); ++axis)
    n *= extents[axis];
  return n;
}

bool is_hdf5_name(const std::string &path)
{
  const std::string ends[] = {".h5", ".hdf5", ".dream3d", ".mat", ".nc"};
  return std::any_of(std::begin(ends), std::end(ends),
                     [&](const std::string &end) { return has_ending(path, end); });
}

bool has_ending(const std::string &path, const std::string &end)
{
  return path.size() >= end.size() &&
         std::equal(end.begin(), end.end(), path.end() - static_cast<long>(end.size()),
                    [](const char a, const char b) {
                      return a == std::tolower(static_cast<unsigned char>(b));
                    });
}

VoxelSource::Kind VoxelSource::kind() const
{
  std::error_code ignored;
  const auto ends = [this](const char *end) { return has_ending(path, end); };
  if (ends(".png") || ends(".tif") || ends(".tiff") || fs::is_directory(path, ignored) ||
      path.find_first_of("*?") != std::string::npos)
    return Kind::stack;
  if (is_hdf5_name(path))
    return Kind::hdf5;
  if (ends(".raw"))
    return Kind::raw;
  if (ends(".vti"))
    throw UserError(path + " is a file of VTK; save its array with numpy.save, as "
                           "doc/voxels.md shows");
  return Kind::numpy;
}

std::unique_ptr<VoxelFile> VoxelFile::open(const VoxelSource &source)
{
  std::unique_ptr<VoxelFile> file;
  switch (source.kind())
    {
    case VoxelSource::Kind::raw:
      file = open_raw(source);
      break;
    case VoxelSource::Kind::hdf5:
      if (source.dataset.empty())
        throw UserError(source.dataset_key + " is empty; name the dataset of voxels in " +
                        source.path);
      file = std::make_unique<Hdf5Voxels>(source);
      break;
    case VoxelSource::Kind::stack:
      return open_picture_stack(source.files());
    default:
      file = open_numpy(source.path);
    }
  const std::vector<std::size_t> &shape = file->shape();
  if (source.components > 1 && (shape.size() != 4 || shape[3] != source.components))
    throw UserError(source.path + " is an array " + text_of_shape(shape) + ", but " +
                    std::to_string(source.components) +
                    " numbers a voxel are one of the shape [z][y][x][" +
                    std::to_string(source.components) + "]");
  if (source.components == 1 && shape.size() == 4 && shape[3] == 1)
    file->extents.pop_back();
  if (source.components == 1 && shape.size() != 3)
    throw UserError(source.path + " is an array " + text_of_shape(file->shape()) +
                    ", but voxels are one of three axes, [z][y][x], or [z][y][x][1]");
  return file;
}
} // namespace mesoslip
