#ifndef mesoslip_io_tiff_image_h
#define mesoslip_io_tiff_image_h

#include "io/number_type.h"

#include <cstddef>
#include <string>
#include <vector>

namespace mesoslip
{
/** A page of a TIFF with one number per pixel. */
struct TiffImage
{
  std::size_t width  = 0;     ///< pixels
  std::size_t height = 0;     ///< pixels
  NumberType type;            ///< number type
  unsigned int bits = 8;      ///< bits per pixel: 1, or the size of the type
  std::vector<double> values; ///< [height][width], the top row first, as stored
};

/**
 * Number of pages; for files of ImageJ or tifffile that store all images behind a single
 * page, number of images.
 * @throws UserError beginning with @p path, also if pages announced by another page or
 * the description are missing; @p one_file: whether this file should contain all images
 */
std::size_t tiff_pages(const std::string &path, const bool one_file = true);

/**
 * Reads page @p page of a TIFF in strips, through libtiff: whole numbers of 1, 8, 16 or
 * 32 bits (1 bit: white is 1) or floating point numbers of 32 or 64 bits.
 * @throws UserError beginning with @p path
 */
TiffImage read_tiff(const std::string &path, const std::size_t page = 0);
} // namespace mesoslip

#endif
