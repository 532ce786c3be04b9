#ifndef mesoslip_io_image_h
#define mesoslip_io_image_h

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A picture as whole numbers. Rows are stored from the bottom, so that y grows upwards
 * as in the grid: value (x, y) is values[y * width + x].
 */
struct Image
{
  unsigned int width  = 0; ///< pixels
  unsigned int height = 0; ///< pixels
  std::vector<int> values; ///< [height][width], the bottom row first
  bool coloured = false;   ///< values are 0xRRGGBB
  bool deep     = false;   ///< PNG with 16 bits per channel, grey levels up to 65535

  /** Digits per number of a text with one number per row; 0: otherwise. */
  unsigned int digits = 0;
};

/**
 * Reads a PNG: grey levels 0 to 255 (0 to 65535 if they have 16 bits) if no pixel has a
 * colour, otherwise 0xRRGGBB for every pixel; a TIFF of one page (read_tiff()) or an
 * array of NumPy, [row][column], with whole numbers. Any other file is read as text:
 * rows of whole numbers from the top, separated by blanks or commas, # begins a comment.
 * @throws UserError naming file (and line).
 */
Image read_image(const std::string &path);
} // namespace mesoslip

#endif
