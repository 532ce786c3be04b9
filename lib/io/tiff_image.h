#ifndef mesoslip_io_tiff_image_h
#define mesoslip_io_tiff_image_h

#include "io/number_type.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/** One page of a TIFF with one number a pixel. */
struct TiffImage
{
  std::size_t width  = 0;     ///< pixels
  std::size_t height = 0;     ///< pixels
  NumberType type;            ///< of the numbers
  std::vector<double> values; ///< [height][width], the top row first, as they are stored
};

/** Number of pages. @throws UserError beginning with @p path */
std::size_t tiff_pages(const std::string &path);

/**
 * Reads page @p page of a TIFF in strips, through libtiff: whole numbers of 8, 16 or 32 bits
 * or floating point numbers of 32 or 64 bits. @throws UserError beginning with @p path
 */
TiffImage read_tiff(const std::string &path, const std::size_t page = 0);
} // namespace mesoslip

#endif
