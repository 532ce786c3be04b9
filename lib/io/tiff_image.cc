#include "io/tiff_image.h"

#include "base/errors.h"
#include "base/files.h"

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
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

/** Whether the last directory read has a strip shorter than its rows: libtiff assumes a
 * wrong byte count, reads past the strip, and only warns. */
bool strip_is_short = false;

void note_short_strip(const char * /*module*/, const char *text, va_list /*values*/)
{
  const std::string warning = text;
  strip_is_short =
    strip_is_short || (warning.rfind("Bogus", 0) == 0 &&
                       warning.find("StripByteCounts") != std::string::npos);
}

TiffFile open_tiff(const std::string &path)
{
  // Errors are detected by return values.
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(note_short_strip);
  require_readable_file("", path);
  TiffFile file(TIFFOpen(path.c_str(), "r"));
  if (!file)
    throw UserError(path +
                    " cannot be opened as a TIFF; check the name, or save it again");
  return file;
}

/** Throws if viewers show the page differently from its stored numbers, or if it has no
 * numbers. */
void require_as_stored(TIFF *file, const std::string &path)
{
  std::uint16_t orientation = ORIENTATION_TOPLEFT, compression = COMPRESSION_NONE;
  TIFFGetFieldDefaulted(file, TIFFTAG_ORIENTATION, &orientation);
  TIFFGetFieldDefaulted(file, TIFFTAG_COMPRESSION, &compression);
  if (orientation != ORIENTATION_TOPLEFT)
    throw UserError(
      path + " is marked as turned or mirrored (its Orientation is " +
      std::to_string(orientation) +
      "), which some programs follow and others do not; save it as it has to "
      "be seen, with Orientation 1");
  if (compression == COMPRESSION_JPEG || compression == COMPRESSION_OJPEG)
    throw UserError(path + " is compressed as a JPEG, which blurs the edges of phases; "
                           "save the original without loss, as LZW does");
}

/** The number type of a page with one number per pixel. */
NumberType type_of_page(TIFF *file, const std::string &path)
{
  require_as_stored(file, path);
  std::uint16_t samples = 1, bits = 1, format = SAMPLEFORMAT_UINT;
  TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(file, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(file, TIFFTAG_SAMPLEFORMAT, &format);
  const bool floating = format == SAMPLEFORMAT_IEEEFP;
  const bool bits_fit =
    bits == 32 || (floating ? bits == 64 : bits == 1 || bits == 8 || bits == 16);
  if (samples != 1 || !bits_fit || format > SAMPLEFORMAT_IEEEFP)
    throw UserError(
      path + " has " + std::to_string(samples) + " numbers of " + std::to_string(bits) +
      " bits a pixel; save it with one of 1, 8, 16 or 32 bits, without colours");
  if (TIFFIsTiled(file) != 0)
    throw UserError(path + " is a TIFF of tiles; save it in strips");
  const char kind           = floating ? 'f' : format == SAMPLEFORMAT_INT ? 'i' : 'u';
  const std::uint16_t probe = 1; // libtiff gives numbers in the order of the machine
  return {kind, std::max(bits / 8U, 1U),
          *reinterpret_cast<const unsigned char *>(&probe) == 0};
}

/** The number after @p key in a text; 0 if there is none. */
std::size_t number_behind(const std::string &text, const std::string &key)
{
  const std::size_t at = text.find(key);
  return at == std::string::npos
           ? 0
           : std::strtoul(text.c_str() + at + key.size(), nullptr, 10);
}

std::string description_of(TIFF *file)
{
  const char *text = nullptr;
  return TIFFGetField(file, TIFFTAG_IMAGEDESCRIPTION, &text) != 0 && text != nullptr
           ? text
           : "";
}

/** Number of images stated in the description of the first page, as written by ImageJ and
 * tifffile, or by OME (where several files may form one body); 0: none. */
std::size_t announced_images(TIFF *file, const bool one_file)
{
  std::uint32_t width = 0, height = 0;
  TIFFGetField(file, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(file, TIFFTAG_IMAGELENGTH, &height);
  const std::string text = description_of(file);
  std::size_t images     = number_behind(text, "images=");
  if (const std::size_t at = text.find("\"shape\": ["); at != std::string::npos)
    {
      double numbers   = 1.;
      const char *next = text.c_str() + at + 9;
      do
        {
          char *end = nullptr;
          numbers *= static_cast<double>(std::strtoul(next + 1, &end, 10));
          next = end;
        }
      while (*next == ',');
      images = static_cast<std::size_t>(numbers / std::max(1., 1. * width * height));
    }
  return one_file ? std::max(images, number_behind(text, "SizeZ=\"")) : images;
}

/** Throws if the description @p text announces several channels or times. */
void require_one_series(const std::string &text,
                        const std::string &path,
                        const bool one_file)
{
  const std::size_t channels =
    std::max(number_behind(text, "channels="),
             one_file ? number_behind(text, "SizeC=\"") : std::size_t{0});
  if (channels > 1)
    throw UserError(path + " has " + std::to_string(channels) +
                    " channels, as its description says; save one of them");
  const auto both = [&text](const char *places, const char *times) {
    return number_behind(text, places) > 1 && number_behind(text, times) > 1;
  };
  if (both("slices=", "frames=") || (one_file && both("SizeZ=\"", "SizeT=\"")))
    throw UserError(path + " has several slices at several times, as its description "
                           "says; save those of one time");
}

/** Offset of the first page if its numbers are stored contiguously as in memory;
 * else 0. */
std::uint64_t begin_of_plain_page(TIFF *file, const std::uint64_t bytes)
{
  std::uint16_t compression = COMPRESSION_NONE;
  std::uint64_t *offsets = nullptr, *counts = nullptr;
  TIFFGetFieldDefaulted(file, TIFFTAG_COMPRESSION, &compression);
  if (compression != COMPRESSION_NONE || TIFFIsTiled(file) != 0 ||
      TIFFGetField(file, TIFFTAG_STRIPOFFSETS, &offsets) == 0 ||
      TIFFGetField(file, TIFFTAG_STRIPBYTECOUNTS, &counts) == 0)
    return 0;
  const std::uint32_t last = TIFFNumberOfStrips(file) - 1;
  return offsets[last] + counts[last] == offsets[0] + bytes ? offsets[0] : 0;
}

/** Reads image @p page of the images behind a single page; see tiff_pages(). */
bool read_behind_page(TIFF *file,
                      const std::string &path,
                      const std::size_t page,
                      std::string &bytes)
{
  const std::uint64_t begin = begin_of_plain_page(file, bytes.size());
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(begin + page * bytes.size()));
  return begin > 0 && page < announced_images(file, true) &&
         in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

/** Values of rows of @p row bytes with one bit per pixel, @p width pixels: 1 for
 * white. */
std::vector<double> values_of_bits(const std::string &bytes,
                                   const std::size_t width,
                                   const std::size_t row,
                                   const bool white_is_0)
{
  std::vector<double> values;
  for (std::size_t begin = 0; begin < bytes.size(); begin += row)
    for (std::size_t x = 0; x < width; ++x)
      {
        const auto byte = static_cast<unsigned char>(bytes[begin + x / 8]);
        values.push_back(((byte >> (7U - x % 8) & 1U) != 0) != white_is_0);
      }
  return values;
}

/** No compression has a higher ratio: a larger claimed size is refused before memory is
 * allocated. */
void require_possible_page(const std::string &path, const double bytes)
{
  constexpr double most = 5000.;
  std::error_code code;
  const auto has = static_cast<double>(std::filesystem::file_size(path, code));
  if (code || !(bytes <= most * has))
    throw UserError(path + " claims " + to_text(bytes) +
                    " bytes of pixels, more than it can hold: it is damaged");
}

/** Whether the strips lie in the file and, if uncompressed, contain all bytes of their
 * rows: libtiff reads the bytes after a strip as its end. */
bool has_all_strips(TIFF *file,
                    const std::string &path,
                    const std::size_t row,
                    const std::uint32_t height)
{
  std::uint16_t compression = COMPRESSION_NONE;
  std::uint32_t rows        = height;
  TIFFGetFieldDefaulted(file, TIFFTAG_COMPRESSION, &compression);
  TIFFGetFieldDefaulted(file, TIFFTAG_ROWSPERSTRIP, &rows);
  rows                   = std::clamp(rows, 1U, height);
  std::uint64_t *offsets = nullptr, *counts = nullptr;
  std::error_code code;
  const std::uint64_t has    = std::filesystem::file_size(path, code);
  const std::uint32_t strips = TIFFNumberOfStrips(file);
  if (code || TIFFGetField(file, TIFFTAG_STRIPOFFSETS, &offsets) == 0 ||
      TIFFGetField(file, TIFFTAG_STRIPBYTECOUNTS, &counts) == 0 ||
      strips != (height - 1) / rows + 1)
    return false;
  for (std::uint32_t s = 0; s < strips; ++s)
    if (offsets[s] > has || counts[s] > has - offsets[s] ||
        (compression == COMPRESSION_NONE &&
         counts[s] < row * std::min(rows, height - s * rows)))
      return false;
  return true;
}
} // namespace

std::size_t tiff_pages(const std::string &path, const bool one_file)
{
  const TiffFile file = open_tiff(path);
  const auto has      = static_cast<std::size_t>(TIFFNumberOfDirectories(file.get()));
  if (has == 0 ||
      TIFFSetDirectory(file.get(), static_cast<std::uint32_t>(has) - 1) == 0 ||
      TIFFLastDirectory(file.get()) == 0)
    throw UserError(path + " is damaged or truncated: behind page " +
                    std::to_string(has) + " another one is missing; save it again");
  TIFFSetDirectory(file.get(), 0);
  require_one_series(description_of(file.get()), path, one_file);
  const std::size_t images = announced_images(file.get(), one_file);
  if (images <= has)
    return has;
  std::uint32_t width = 0, height = 0;
  TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height);
  const std::uint64_t bytes =
    std::uint64_t{width} * height * type_of_page(file.get(), path).bytes;
  std::error_code code;
  const std::uint64_t begin = begin_of_plain_page(file.get(), bytes),
                      size  = std::filesystem::file_size(path, code);
  // In large stacks the images follow behind a single page.
  if (has == 1 && begin > 0 && !code &&
      (size - begin) / std::max(bytes, std::uint64_t{1}) >= images)
    return images;
  throw UserError(path + " tells of " + std::to_string(images) +
                  " images in its description, but has " + std::to_string(has) +
                  (has == 1 ? " page" : " pages") +
                  "; save all images again, each as a page");
}

TiffImage read_tiff(const std::string &path, const std::size_t page)
{
  const TiffFile file       = open_tiff(path);
  const std::string damaged = path + ": page " + std::to_string(page + 1) +
                              " of this TIFF is damaged or truncated; save it again";
  strip_is_short = false;
  const bool has_page =
    TIFFSetDirectory(file.get(), static_cast<std::uint32_t>(page)) != 0;
  std::uint32_t width = 0, height = 0;
  if (!(has_page || TIFFSetDirectory(file.get(), 0) != 0) ||
      TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &width) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &height) == 0 || width == 0 ||
      height == 0)
    throw UserError(damaged);
  TiffImage image;
  image.width        = width;
  image.height       = height;
  image.type         = type_of_page(file.get(), path);
  std::uint16_t bits = 1, meaning = PHOTOMETRIC_MINISBLACK;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetField(file.get(), TIFFTAG_PHOTOMETRIC, &meaning);
  image.bits = bits;
  require_possible_page(path, 1. * width * height * bits / 8.);
  const auto row = static_cast<std::size_t>(TIFFScanlineSize64(file.get()));
  if (row != (image.width * bits + 7) / 8)
    throw UserError(damaged);
  if (strip_is_short || (has_page && !has_all_strips(file.get(), path, row, height)))
    throw UserError(damaged);
  std::string bytes(row * height, '\0');
  if (has_page)
    for (std::uint32_t y = 0; y < height; ++y)
      if (TIFFReadScanline(file.get(), &bytes[y * row], y) != 1)
        throw UserError(damaged);
  if (!has_page && !read_behind_page(file.get(), path, page, bytes))
    throw UserError(damaged);
  if (!has_page)
    image.type.big_endian = TIFFIsBigEndian(file.get()) != 0;
  image.values =
    bits == 1 ? values_of_bits(bytes, image.width, row, meaning == PHOTOMETRIC_MINISWHITE)
              : image.type.decode(bytes.data(), image.width * image.height, path);
  return image;
}
} // namespace mesoslip
