#ifndef mesoslip_io_png_reader_h
#define mesoslip_io_png_reader_h

#include "io/image.h"

#include <string>

namespace mesoslip
{
/** Whether @p bytes begin as every PNG does. */
bool is_png(const std::string &bytes);

/**
 * The picture in the PNG @p bytes, as read_image() describes it. Values are those in the
 * file: chunks about gamma and colour spaces, which ask for other values on a screen, are
 * not heeded. @throws UserError naming @p path for what is damaged or transparent, and
 * for colours of 16 bits.
 */
Image read_png(const std::string &path, const std::string &bytes);
} // namespace mesoslip

#endif
