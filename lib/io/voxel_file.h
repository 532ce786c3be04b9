#ifndef mesoslip_io_voxel_file_h
#define mesoslip_io_voxel_file_h

#include "io/number_type.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** Location of voxels, and properties that their file does not state. */
struct VoxelSource
{
  /** A file, the folder of a stack of pictures, or a pattern of their names. */
  std::string path;
  std::string dataset; ///< path of the dataset in an HDF5 file

  /** Numbers of voxels of a .raw along x, y and z. */
  std::array<std::size_t, 3> raw_shape = {};
  NumberType raw_type; ///< number type of a .raw

  unsigned int components = 1; ///< numbers per voxel: 1, or the extent of a fourth axis

  std::string dataset_key = "Microstructure/Dataset"; ///< key named in messages

  /** Keys named in messages on a .raw. */
  std::string raw_keys = "Microstructure/Raw shape or Raw type";

  /** The kinds of files. */
  enum class Kind
  {
    numpy,
    raw,
    hdf5,
    stack
  };

  /** Kind by the extension of the name.
   * @throws UserError beginning with the path if it is not supported. */
  Kind kind() const;

  /** The file, or the pictures of the stack sorted by name, without names that begin with
   * a dot.
   * @throws UserError beginning with the path if there is none, or as
   * require_slices_in_order() does */
  std::vector<std::string> files() const;
};

/** Whether a path ends in @p end, upper or lower case. */
bool has_ending(const std::string &path, const std::string &end);

/** Whether a name has an extension of HDF5 files, including DREAM.3D, MATLAB and
 * NetCDF. */
bool is_hdf5_name(const std::string &path);

/** Reader of numbers [z][y][x], or [z][y][x][component], of a file or of a stack of
 * pictures, plane by plane. */
class VoxelFile
{
public:
  virtual ~VoxelFile() = default;

  /** Reads the header.
   * @throws UserError beginning with the path */
  static std::unique_ptr<VoxelFile> open(const VoxelSource &source);

  /** Shape as stored, the slowest axis first; voxels have three or four axes. */
  const std::vector<std::size_t> &shape() const
  {
    return extents;
  }

  /** Whether the number type holds only whole numbers. */
  bool is_whole() const
  {
    return whole;
  }

  /** Number type in messages: "'<f8'". */
  const std::string &type_text() const
  {
    return type_name;
  }

  /** The values [y][x], or [y][x][component], of plane @p z. @throws UserError beginning
   *  with the path */
  virtual std::vector<double> plane(const std::size_t z) = 0;

protected:
  /** Numbers per plane. */
  std::size_t plane_size() const;

  std::vector<std::size_t> extents; ///< see shape()
  bool whole = true;                ///< see is_whole()
  std::string type_name;            ///< see type_text()
};

/** A stack of pictures, PNG or TIFF, one per plane, or of the pages of one TIFF. Value
 * (x, y) belongs to column x and row y; the top row is y = 0. */
std::unique_ptr<VoxelFile> open_picture_stack(const std::vector<std::string> &files);
} // namespace mesoslip

#endif
