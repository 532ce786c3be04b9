#ifndef mesoslip_io_voxel_file_h
#define mesoslip_io_voxel_file_h

#include "io/number_type.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace mesoslip
{
/** Where voxels lie, and what their file does not say. */
struct VoxelSource
{
  /** A file, the folder of a stack of pictures or a pattern of their names. */
  std::string path;
  std::string dataset; ///< path of it in an HDF5 file

  /** Numbers of voxels of a .raw along x, y and z. */
  std::array<std::size_t, 3> raw_shape = {};
  NumberType raw_type; ///< of the numbers of a .raw

  unsigned int components = 1; ///< numbers a voxel: 1, or a fourth axis of so many

  std::string dataset_key = "Microstructure/Dataset"; ///< for messages

  /** For messages as well. */
  std::string raw_keys = "Microstructure/Raw shape or Raw type";

  /** The kinds of files. */
  enum class Kind
  {
    numpy,
    raw,
    hdf5,
    stack
  };

  /** By the end of the name. @throws UserError beginning with the path if none is read. */
  Kind kind() const;

  /** The file, or the pictures of the stack in the order of their names, without those that
   * begin with a dot. @throws UserError beginning with the path if there is none, or as
   * require_slices_in_order() does */
  std::vector<std::string> files() const;
};

/** Whether a path is that of a file whose name ends in @p end, upper or lower case. */
bool has_ending(const std::string &path, const std::string &end);

/** Whether it ends as files of HDF5 do, also those of DREAM.3D, MATLAB and NetCDF. */
bool is_hdf5_name(const std::string &path);

/** Numbers [z][y][x], or [z][y][x][component], of a file or of a stack of pictures, read plane
 *  by plane. */
class VoxelFile
{
public:
  virtual ~VoxelFile() = default;

  /** Reads what there is about the numbers. @throws UserError beginning with the path */
  static std::unique_ptr<VoxelFile> open(const VoxelSource &source);

  /** Extents as stored, the slowest axis first; of voxels these are three, or four. */
  const std::vector<std::size_t> &shape() const
  {
    return extents;
  }

  /** Whether all values are whole numbers, by their type. */
  bool is_whole() const
  {
    return whole;
  }

  /** Of the numbers, for messages: "'<f8'". */
  const std::string &type_text() const
  {
    return type_name;
  }

  /** The values [y][x], or [y][x][component], of plane @p z. @throws UserError beginning
   *  with the path */
  virtual std::vector<double> plane(const std::size_t z) = 0;

protected:
  /** Numbers of a plane. */
  std::size_t plane_size() const;

  std::vector<std::size_t> extents; ///< see shape()
  bool whole = true;                ///< see is_whole()
  std::string type_name;            ///< see type_text()
};

/** A stack of pictures, PNG or TIFF, one a plane, or of the pages of one TIFF. Value (x, y)
 * is that of column x and row y, the top row being y = 0. */
std::unique_ptr<VoxelFile> open_picture_stack(const std::vector<std::string> &files);
} // namespace mesoslip

#endif
