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
  unsigned int bits = 8;      ///< of a pixel: 1, or those of the type
  std::vector<double> values; ///< [height][width], the top row first, as they are stored
};

/**
 * Number of pages. Where ImageJ or tifffile have put all images behind the only page, it is that of
 * the images. @throws UserError beginning with @p path, also if pages are missing that another one
 * or the description tells of; @p one_file: if the file should have all images
 */
std::size_t tiff_pages(const std::string &path, const bool one_file = true);

/**
 * Reads page @p page of a TIFF in strips, through libtiff: whole numbers of 1, 8, 16 or 32 bits, of
 * which the one bit is 1 where the picture is white, or floating point numbers of 32 or 64 bits.
 * @throws UserError beginning with @p path
 */
TiffImage read_tiff(const std::string &path, const std::size_t page = 0);
} // namespace mesoslip

#endif
