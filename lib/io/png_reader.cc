#include "io/png_reader.h"

#include "base/errors.h"
#include "base/text.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <png.h>

namespace mesoslip
{
namespace
{
/** Rows from the top; a value of 16 bits has its higher byte first. */
struct Pixels
{
  unsigned int width    = 0;
  unsigned int height   = 0;
  unsigned int channels = 0; ///< grey, grey and alpha, RGB, or RGB and alpha
  unsigned int bits     = 0; ///< of a channel: 8 or 16
  std::vector<unsigned char> bytes;

  /** Channel @p c of pixel number @p i. */
  int value(const std::size_t i, const unsigned int c) const
  {
    const std::size_t k = i * channels + c;
    return bits == 8 ? bytes[k] : (bytes[2 * k] << 8) + bytes[2 * k + 1];
  }
};

/** What libpng hands to our functions: the file, and where to put a message. */
struct PngSource
{
  const std::string &bytes;
  std::size_t at   = 0;
  char message[80] = "out of memory";
};

[[noreturn]] void note_error(png_structp png, const char *text)
{
  auto *source = static_cast<PngSource *>(png_get_error_ptr(png));
  std::snprintf(source->message, sizeof source->message, "%s", text);
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, const char *)
{
}

void next_bytes(png_structp png, png_bytep out, const std::size_t n)
{
  auto *source = static_cast<PngSource *>(png_get_io_ptr(png));
  if (n > source->bytes.size() - source->at)
    png_error(png, "the file ends too early");
  std::memcpy(out, source->bytes.data() + source->at, n);
  source->at += n;
}

/**
 * Reads the whole image. libpng reports errors by longjmp(), which runs no destructors:
 * there are no objects behind the mark that it returns to. False if it did.
 */
bool read_all(png_structp png, png_infop info, PngSource &source)
{
  if (info == nullptr || setjmp(png_jmpbuf(png)) != 0)
    return false;
  png_set_read_fn(png, &source, next_bytes);
  // All chunks but those that hold the pixels, the palette and its transparency.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  // Palettes to RGB, 1, 2, 4 bits to 8, transparent colours to alpha.
  png_read_png(png, info, PNG_TRANSFORM_EXPAND, nullptr);
  return true;
}

/** Deflate shrinks to 1/1032 at best: nothing may make us ask for all memory. */
void require_possible_size(const std::string &path, const std::string &bytes)
{
  // Width and height follow the signature, the length and the name of the first chunk.
  const auto number = [&bytes](const std::size_t at) {
    double value = 0.;
    for (std::size_t i = at; i < at + 4 && i < bytes.size(); ++i)
      value = 256. * value + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  constexpr double most_pixels_per_byte = 8. * 1032.;
  const double width = number(16), height = number(20);
  if (!(width * height <= most_pixels_per_byte * static_cast<double>(bytes.size())))
    throw UserError(path + ": this PNG claims " + to_text(width) + " x " +
                    to_text(height) + " pixels, more than its " +
                    std::to_string(bytes.size()) + " bytes can hold: it is damaged");
}

Pixels decode(const std::string &path, const std::string &bytes)
{
  require_possible_size(path, bytes);
  PngSource source{bytes};
  png_structp png =
    png_create_read_struct(PNG_LIBPNG_VER_STRING, &source, note_error, ignore_warning);
  png_infop info  = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool done = read_all(png, info, source);
  Pixels pixels;
  if (done)
    {
      pixels.width     = png_get_image_width(png, info);
      pixels.height    = png_get_image_height(png, info);
      pixels.channels  = png_get_channels(png, info);
      pixels.bits      = png_get_bit_depth(png, info);
      png_bytepp rows  = png_get_rows(png, info);
      const auto width = static_cast<std::ptrdiff_t>(png_get_rowbytes(png, info));
      for (unsigned int y = 0; y < pixels.height; ++y)
        pixels.bytes.insert(pixels.bytes.end(), rows[y], rows[y] + width);
    }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!done)
    throw UserError(path + ": this PNG is damaged or truncated (" + source.message + ")");
  if (pixels.bits == 16 && pixels.channels > 2)
    throw UserError(path + " has colours of 16 bits a channel; save it with 8 bits, or "
                           "as grey levels");
  return pixels;
}

/** Many programs write an alpha channel even where nothing is transparent. */
void require_opaque(const std::string &path, const Pixels &pixels)
{
  const std::size_t n = static_cast<std::size_t>(pixels.width) * pixels.height;
  if (pixels.channels % 2 == 0)
    for (std::size_t i = 0; i < n; ++i)
      if (pixels.value(i, pixels.channels - 1) != (pixels.bits == 8 ? 255 : 65535))
        throw UserError(path +
                        " has transparent pixels, which belong to no phase; save it "
                        "without transparency");
}
} // namespace

bool is_png(const std::string &bytes)
{
  static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  return bytes.size() >= 8 && std::memcmp(bytes.data(), signature, 8) == 0;
}

Image read_png(const std::string &path, const std::string &bytes)
{
  const Pixels pixels = decode(path, bytes);
  require_opaque(path, pixels);
  Image image;
  image.width         = pixels.width;
  image.height        = pixels.height;
  const std::size_t n = static_cast<std::size_t>(pixels.width) * pixels.height;
  for (std::size_t i = 0; i < n && pixels.channels > 2 && !image.coloured; ++i)
    image.coloured = pixels.value(i, 0) != pixels.value(i, 1) ||
                     pixels.value(i, 0) != pixels.value(i, 2);
  image.values.reserve(n);
  for (unsigned int y = image.height; y-- > 0;) // the file begins at the top
    for (unsigned int x = 0; x < image.width; ++x)
      {
        const std::size_t i = static_cast<std::size_t>(y) * image.width + x;
        image.values.push_back(image.coloured
                                 ? (pixels.value(i, 0) << 16) +
                                     (pixels.value(i, 1) << 8) + pixels.value(i, 2)
                                 : pixels.value(i, 0));
      }
  return image;
}
} // namespace mesoslip
