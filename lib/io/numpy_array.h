#ifndef mesoslip_io_numpy_array_h
#define mesoslip_io_numpy_array_h

#include "io/number_type.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** What the header of a .npy says about an array of numbers. */
struct NumpyHeader
{
  std::vector<std::size_t> shape; ///< extents of the axes, as NumPy has them
  bool fortran_order = false;     ///< whether the first axis is the fastest
  NumberType type;                ///< of the numbers
  std::size_t offset = 0;         ///< bytes in front of the numbers

  /** Product of the extents. */
  std::size_t size() const;
};

/**
 * The header of a .npy (format 1 to 3). @throws UserError beginning with @p path unless it
 * is an array of numbers or truth values and the file has as many as it says
 */
NumpyHeader read_numpy_header(const std::string &path);
} // namespace mesoslip

#endif
