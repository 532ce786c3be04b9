#include "io/tiff_image.h"

#include "base/errors.h"
#include "base/files.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <tiffio.h>

namespace mesoslip
{
namespace
{
struct CloseTiff
{
  void operator()(TIFF *file) const
  {
    TIFFClose(file);
  }
};

using TiffFile = std::unique_ptr<TIFF, CloseTiff>;

TiffFile open_tiff(const std::string &path)
{
  // What goes wrong is told by the values that functions return.
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  require_readable_file("", path);
  TiffFile file(TIFFOpen(path.c_str(), "r"));
  if (!file)
    throw UserError(path +
                    " cannot be opened as a TIFF; check the name, or save it again");
  return file;
}

/** The type of the numbers of a page with one of them a pixel. */
NumberType type_of_page(TIFF *file, const std::string &path)
{
  std::uint16_t samples = 1, bits = 1, format = SAMPLEFORMAT_UINT;
  TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(file, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLEFORMAT, &format);
  const bool floating = format == SAMPLEFORMAT_IEEEFP;
  const bool bits_fit = bits == 32 || (floating ? bits == 64 : bits == 8 || bits == 16);
  if (samples != 1 || !bits_fit || format > SAMPLEFORMAT_IEEEFP)
    throw UserError(
      path + " has " + std::to_string(samples) + " numbers of " + std::to_string(bits) +
      " bits a pixel; save it with one of 8, 16 or 32 bits, without colours");
  if (TIFFIsTiled(file) != 0)
    throw UserError(path + " is a TIFF of tiles; save it in strips");
  const char kind           = floating ? 'f' : format == SAMPLEFORMAT_INT ? 'i' : 'u';
  const std::uint16_t probe = 1; // libtiff gives numbers in the order of the machine
  return {kind, bits / 8U, *reinterpret_cast<const unsigned char *>(&probe) == 0};
}

/** No compression shrinks further: nothing may make us ask for all memory. */
void require_possible_page(const std::string &path, const double bytes)
{
  constexpr double most = 5000.;
  std::error_code code;
  const auto has = static_cast<double>(std::filesystem::file_size(path, code));
  if (code || !(bytes <= most * has))
    throw UserError(path + " claims " + to_text(bytes) +
                    " bytes of pixels, more than it can hold: it is damaged");
}
} // namespace

std::size_t tiff_pages(const std::string &path)
{
  return TIFFNumberOfDirectories(open_tiff(path).get());
}

TiffImage read_tiff(const std::string &path, const std::size_t page)
{
  const TiffFile file       = open_tiff(path);
  const std::string damaged = path + ": page " + std::to_string(page + 1) +
                              " of this TIFF is damaged or truncated; save it again";
  std::uint32_t width = 0, height = 0;
  if (TIFFSetDirectory(file.get(), static_cast<std::uint32_t>(page)) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height) == 0 || width == 0 ||
      height == 0)
    throw UserError(damaged);
  TiffImage image;
  image.width  = width;
  image.height = height;
  image.type   = type_of_page(file.get(), path);
  require_possible_page(path, 1. * width * height * image.type.bytes);
  const auto row = static_cast<std::size_t>(TIFFScanlineSize64(file.get()));
  if (row != image.width * image.type.bytes)
    throw UserError(damaged);
  std::string bytes(row * height, '\0');
  for (std::uint32_t y = 0; y < height; ++y)
    if (TIFFReadScanline(file.get(), &bytes[y * row], y) != 1)
      throw UserError(damaged);
  image.values = image.type.decode(bytes.data(), image.width * image.height, path);
  return image;
}
} // namespace mesoslip
