#include "io/image.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"

#include <algorithm>
#include <cctype>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <limits>
#include <png.h>
#include <sstream>
#include <utility>

namespace mesoslip
{
namespace
{
/** What the first bytes of some other kinds of files say. */
void refuse_other_kinds(const std::string &path, const std::string &bytes)
{
  static const std::pair<std::string, const char *> kinds[] = {
    {"\xff\xd8\xff", "a JPEG, which blurs the edges of phases"},
    {std::string("II*\0", 4), "a TIFF"},
    {std::string("MM\0*", 4), "a TIFF"},
    {"GIF8", "a GIF"},
    {"P2", "a PGM"},
    {"P3", "a PPM"},
    {"P5", "a PGM"},
    {"P6", "a PPM"}};
  for (const auto &[begin, name] : kinds)
    if (bytes.compare(0, begin.size(), begin) == 0)
      throw UserError(path + " is " + name + "; save it as PNG");
  if (bytes.find('\0') != std::string::npos)
    throw UserError(path + " is neither a PNG nor a text file with whole numbers; save "
                           "it as PNG");
}

/** "0011" is hardly the number eleven. */
bool has_leading_zero(const std::string &word)
{
  const std::size_t first = word[0] == '-' || word[0] == '+' ? 1 : 0;
  return word.size() > first + 1 && word[first] == '0' &&
         std::isdigit(static_cast<unsigned char>(word[first + 1])) != 0;
}

/** Whole numbers of one line; commas count as blanks. */
std::vector<int> parse_line(std::string line, const std::string &where)
{
  std::replace(line.begin(), line.end(), ',', ' ');
  std::replace(line.begin(), line.end(), ';', ' ');
  std::istringstream words(line.substr(0, line.find('#')));
  std::vector<int> values;
  std::string word;
  while (words >> word)
    {
      long value;
      if (!parse_number(word, value) || value < std::numeric_limits<int>::min() ||
          value > std::numeric_limits<int>::max())
        throw UserError(where + "value " + std::to_string(values.size() + 1) + " is '" +
                        word + "', which is not a whole number");
      if (has_leading_zero(word))
        throw UserError(where + "value " + std::to_string(values.size() + 1) + " is '" +
                        word +
                        "', a number that begins with 0; if every digit is a "
                        "pixel, put blanks between them");
      values.push_back(static_cast<int>(value));
    }
  return values;
}

/** Digits of every number of the first column; 0 when they differ. */
unsigned int common_digits(const std::vector<std::vector<int>> &rows)
{
  const auto digits = [](const std::vector<int> &row) {
    return row.front() < 0 ? 0 : std::to_string(row.front()).size();
  };
  const bool common = std::all_of(rows.begin(), rows.end(), [&](const auto &row) {
    return digits(row) == digits(rows.front());
  });
  return common ? static_cast<unsigned int>(digits(rows.front())) : 0;
}

Image read_text(const std::string &path, const std::string &text)
{
  refuse_other_kinds(path, text);
  std::vector<std::vector<int>> rows;
  std::istringstream in(plain_lines(text));
  std::string line;
  for (unsigned int number = 1; std::getline(in, line); ++number)
    {
      const std::string where = path + ":" + std::to_string(number) + ": ";
      std::vector<int> row    = parse_line(line, where);
      if (row.empty())
        continue;
      if (!rows.empty() && row.size() != rows.front().size())
        throw UserError(where + std::to_string(row.size()) +
                        " values, but the rows before have " +
                        std::to_string(rows.front().size()));
      rows.push_back(std::move(row));
    }
  if (rows.empty())
    throw UserError(path + " is empty, but an image of the phases is needed");

  Image image;
  image.height = static_cast<unsigned int>(rows.size());
  image.width  = static_cast<unsigned int>(rows.front().size());
  if (image.width == 1)
    image.digits = common_digits(rows);
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    image.values.insert(image.values.end(), row->begin(), row->end());
  return image;
}

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

/** Keeps the message of an error, which libpng hands over before it gives up. */
[[noreturn]] void note_error(png_structp png, const char *text)
{
  *static_cast<std::string *>(png_get_error_ptr(png)) = text;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp, const char *)
{
}

/**
 * Reads the whole image. libpng reports errors by longjmp(), which runs no destructors:
 * there are no objects behind the mark that it returns to. False if it did.
 */
bool read_all(png_structp png, png_infop info, std::FILE *file)
{
  if (info == nullptr || file == nullptr || setjmp(png_jmpbuf(png)) != 0)
    return false;
  png_init_io(png, file);
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
  std::string message = "out of memory";
  png_structp png =
    png_create_read_struct(PNG_LIBPNG_VER_STRING, &message, note_error, ignore_warning);
  std::FILE *file = fmemopen(const_cast<char *>(bytes.data()), bytes.size(), "rb");
  png_infop info  = png != nullptr ? png_create_info_struct(png) : nullptr;
  const bool done = read_all(png, info, file);
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
  if (file != nullptr)
    std::fclose(file);
  if (!done)
    throw UserError(path + ": this PNG is damaged or truncated (" + message + ")");
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

bool is_png(const std::string &bytes)
{
  static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  return bytes.size() >= 8 && std::memcmp(bytes.data(), signature, 8) == 0;
}

/**
 * Values are those in the file: chunks about gamma and colour spaces, which ask for other
 * values on a screen, are not heeded.
 */
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
} // namespace

Image read_image(const std::string &path)
{
  const std::string bytes = read_file(path);
  return is_png(bytes) ? read_png(path, bytes) : read_text(path, bytes);
}
} // namespace mesoslip
