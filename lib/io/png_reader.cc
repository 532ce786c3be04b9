#include "io/png_reader.h"

#include "base/errors.h"

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

/**
 * libpng reports errors by longjmp(), which runs no destructors: each function that calls
 * it has a mark of its own to return to, and no objects behind that mark.
 */
class PngReader
{
public:
  explicit PngReader(const std::string &all_bytes)
    : bytes(all_bytes)
    , png(png_create_read_struct(PNG_LIBPNG_VER_STRING, this, note_error, ignore_warning))
    , info(png != nullptr ? png_create_info_struct(png) : nullptr)
  {
  }

  ~PngReader()
  {
    png_destroy_read_struct(&png, &info, nullptr);
  }

  PngReader(const PngReader &)            = delete;
  PngReader &operator=(const PngReader &) = delete;

  /** What is in the file before the pixels, and how these will be handed over. */
  bool read_header(Pixels &pixels)
  {
    if (info == nullptr || setjmp(png_jmpbuf(png)) != 0)
      return false;
    png_set_read_fn(png, this, next_bytes);
    // All chunks but those that hold the pixels, the palette and its transparency.
    png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
    png_read_info(png, info);
    png_set_expand(
      png); // palettes to RGB, 1, 2, 4 bits to 8, transparent colours to alpha
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    pixels.width    = png_get_image_width(png, info);
    pixels.height   = png_get_image_height(png, info);
    pixels.channels = png_get_channels(png, info);
    pixels.bits     = png_get_bit_depth(png, info);
    return true;
  }

  /** @p rows point to the begin of each row. */
  bool read_rows(unsigned char **rows)
  {
    if (setjmp(png_jmpbuf(png)) != 0)
      return false;
    png_read_image(png, rows);
    return true;
  }

  const char *error() const
  {
    return message;
  }

private:
  [[noreturn]] static void note_error(png_structp png, const char *text)
  {
    auto *reader = static_cast<PngReader *>(png_get_error_ptr(png));
    std::snprintf(reader->message, sizeof reader->message, "%s", text);
    png_longjmp(png, 1);
  }

  static void ignore_warning(png_structp, const char *)
  {
  }

  static void next_bytes(png_structp png, png_bytep out, const std::size_t n)
  {
    auto *reader = static_cast<PngReader *>(png_get_io_ptr(png));
    if (n > reader->bytes.size() - reader->at)
      png_error(png, "the file ends too early");
    std::memcpy(out, reader->bytes.data() + reader->at, n);
    reader->at += n;
  }

  const std::string &bytes;
  std::size_t at   = 0;
  char message[80] = "out of memory";
  png_structp png;
  png_infop info;
};

/** Deflate shrinks to 1/1032 at best: nothing may make us ask for all memory. */
void require_possible_size(const std::string &path,
                           const Pixels &pixels,
                           const std::size_t n_bytes)
{
  constexpr double most_pixels_per_byte = 8. * 1032.;
  if (!(static_cast<double>(pixels.width) * pixels.height <=
        most_pixels_per_byte * static_cast<double>(n_bytes)))
    throw UserError(path + ": this PNG claims " + std::to_string(pixels.width) + " x " +
                    std::to_string(pixels.height) + " pixels, more than its " +
                    std::to_string(n_bytes) + " bytes can hold: it is damaged");
}

Pixels decode(const std::string &path, const std::string &bytes)
{
  Pixels pixels;
  PngReader reader(bytes);
  if (!reader.read_header(pixels))
    throw UserError(path + ": this PNG cannot be read (" + reader.error() + ")");
  if (pixels.bits == 16 && pixels.channels > 2)
    throw UserError(path + " has colours of 16 bits a channel; save it with 8 bits, or "
                           "as grey levels");
  require_possible_size(path, pixels, bytes.size());
  const std::size_t row_length =
    static_cast<std::size_t>(pixels.width) * pixels.channels * pixels.bits / 8;
  pixels.bytes.resize(row_length * pixels.height);
  std::vector<unsigned char *> rows;
  for (unsigned int y = 0; y < pixels.height; ++y)
    rows.push_back(pixels.bytes.data() + y * row_length);
  if (!reader.read_rows(rows.data()))
    throw UserError(path + ": this PNG is damaged or truncated (" + reader.error() + ")");
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
