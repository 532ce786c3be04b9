#ifndef mesoslip_io_numpy_array_h
#define mesoslip_io_numpy_array_h

#include "io/number_type.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** Header of a .npy file with an array of numbers. */
struct NumpyHeader
{
  std::vector<std::size_t> shape; ///< extents of the axes, in NumPy's order
  bool fortran_order = false;     ///< whether the first axis is the fastest
  NumberType type;                ///< number type
  std::size_t offset = 0;         ///< file offset of the numbers (bytes)

  /** Number of values. */
  std::size_t size() const;
};

/**
 * Reads the header of a .npy (format 1 to 3).
 * @throws UserError beginning with @p path unless it is an array of numbers or truth
 * values and the file contains all of them
 */
NumpyHeader read_numpy_header(const std::string &path);
} // namespace mesoslip

#endif
