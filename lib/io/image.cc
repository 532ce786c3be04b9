#include "io/image.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "io/hdf5_file.h"
#include "io/numpy_array.h"
#include "io/tiff_image.h"

#include <algorithm>
#include <cctype>
#include <cmath>
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
/** Throws if the first bytes identify another kind of file. */
void refuse_other_kinds(const std::string &path, const std::string &bytes)
{
  static const std::pair<std::string, const char *> kinds[] = {
    {"\xff\xd8\xff", "a JPEG, which blurs the edges of phases"},
    {"GIF8", "a GIF"},
    {"P2", "a PGM"},
    {"P3", "a PPM"},
    {"P5", "a PGM"},
    {"P6", "a PPM"}};
  for (const auto &[begin, name] : kinds)
    if (bytes.compare(0, begin.size(), begin) == 0)
      throw UserError(path + " is " + name + "; save it as PNG");
  if (bytes.find('\0') != std::string::npos)
    throw UserError(path + " is neither a PNG, a TIFF, a .npy nor a text file with whole "
                           "numbers; save it as PNG");
}

/** A leading zero, as in "0011", indicates a row of digits. */
bool has_leading_zero(const std::string &word)
{
  const std::size_t first = word[0] == '-' || word[0] == '+' ? 1 : 0;
  return word.size() > first + 1 && word[first] == '0' &&
         std::isdigit(static_cast<unsigned char>(word[first + 1])) != 0;
}

/** False if @p word is no whole number, also as NumPy's 1.000000000000000000e+00. */
bool parse_whole(const std::string &word, double &value)
{
  return parse_number(word, value) && value == std::floor(value);
}

/** Throws if a comma of the line has no number before it; it may end with a comma. */
void require_no_gaps(const std::string &line, const std::string &where)
{
  std::size_t begin = 0, end = 0;
  for (; (end = line.find_first_of(",;", begin)) != std::string::npos; begin = end + 1)
    if (line.find_first_not_of(" \t", begin) == end)
      throw UserError(where + "a value is missing before '" + line[end] +
                      "'; write the number of its phase");
}

/** Whole numbers of one line; commas are treated as blanks. */
std::vector<int> parse_line(std::string line, const std::string &where)
{
  line.resize(std::min(line.size(), line.find('#')));
  require_no_gaps(line, where);
  std::replace(line.begin(), line.end(), ',', ' ');
  std::replace(line.begin(), line.end(), ';', ' ');
  std::istringstream words(line);
  std::vector<int> values;
  std::string word;
  while (words >> word)
    {
      double value        = 0.;
      const bool is_whole = parse_whole(word, value);
      if (!is_whole || !(std::fabs(value) <= std::numeric_limits<int>::max()))
        throw UserError(where + "value " + std::to_string(values.size() + 1) + " is '" +
                        word +
                        (is_whole ? "', a whole number too large for 32 bits"
                                  : "', which is not a whole number"));
      if (has_leading_zero(word))
        throw UserError(where + "value " + std::to_string(values.size() + 1) + " is '" +
                        word +
                        "', a number that begins with 0; if every digit is a "
                        "pixel, put blanks between them");
      values.push_back(static_cast<int>(value));
    }
  return values;
}

/** Common number of digits of the first column; 0 if they differ. */
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

/** Rows from the top; 16-bit values have the higher byte first. */
struct Pixels
{
  unsigned int width    = 0;
  unsigned int height   = 0;
  unsigned int channels = 0; ///< grey, grey and alpha, RGB, or RGB and alpha
  unsigned int bits     = 0; ///< per channel: 8 or 16
  std::vector<unsigned char> bytes;

  /** Channel @p c of pixel number @p i. */
  int value(const std::size_t i, const unsigned int c) const
  {
    const std::size_t k = i * channels + c;
    return bits == 8 ? bytes[k] : (bytes[2 * k] << 8) + bytes[2 * k + 1];
  }
};

/** Stores the message of an error, which libpng passes before it aborts. */
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
 * no objects are created after setjmp(). False after an error.
 */
bool read_all(png_structp png, png_infop info, std::FILE *file)
{
  if (info == nullptr || file == nullptr || setjmp(png_jmpbuf(png)) != 0)
    return false;
  png_init_io(png, file);
  // Ignores all chunks except pixels, palette and its transparency.
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  // Converts palettes to RGB, 1, 2, 4 bits to 8, transparent colours to alpha.
  png_read_png(png, info, PNG_TRANSFORM_EXPAND, nullptr);
  return true;
}

/** Deflate compresses to 1/1032 at best: refuses larger sizes before allocation. */
void require_possible_size(const std::string &path, const std::string &bytes)
{
  // Width and height follow the signature and the length and name of the first chunk.
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

/** Many programs write an alpha channel even if the image is fully opaque. */
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
 * Values are those of the file: chunks on gamma and colour spaces, which change values
 * on a screen, are ignored.
 */
Image read_png(const std::string &path, const std::string &bytes)
{
  const Pixels pixels = decode(path, bytes);
  require_opaque(path, pixels);
  Image image;
  image.width         = pixels.width;
  image.height        = pixels.height;
  image.deep          = pixels.bits == 16;
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

/** A picture of @p values, the top row first. */
Image whole_numbers(const std::string &path,
                    const std::size_t width,
                    const std::size_t height,
                    const std::vector<double> &values)
{
  Image image;
  image.width  = static_cast<unsigned int>(width);
  image.height = static_cast<unsigned int>(height);
  image.values.reserve(values.size());
  for (std::size_t y = height; y-- > 0;)
    for (std::size_t x = 0; x < width; ++x)
      if (const double value = values[y * width + x];
          value == std::floor(value) &&
          std::fabs(value) <= std::numeric_limits<int>::max())
        image.values.push_back(static_cast<int>(value));
      else
        throw UserError(
          path + " holds " + to_text(value) + ", but pictures are of whole numbers" +
          (!std::isfinite(value) ? "; give such pixels the number of a phase"
           : std::fabs(value) > std::numeric_limits<int>::max()
             ? " that 32 bits hold; give the phases smaller ones"
             : "; scale its numbers, such as 0 to 1 to 0 to 255, and round them"));
  return image;
}

Image read_numpy(const std::string &path, const std::string &bytes)
{
  NumpyHeader header = read_numpy_header(path);
  if (header.shape.size() == 3 && header.shape[2] == 1)
    header.shape.pop_back();
  if (header.shape.size() != 2 || header.size() == 0)
    throw UserError(path + " is an array " + to_text(Shape(header.shape)) +
                    ", but a picture is one of two axes, [row][column], with pixels");
  const std::size_t height = header.shape[0], width = header.shape[1];
  std::vector<double> values =
    header.type.decode(&bytes[header.offset], header.size(), path);
  if (header.fortran_order)
    {
      const std::vector<double> columns = values;
      for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x)
          values[y * width + x] = columns[x * height + y];
    }
  return whole_numbers(path, width, height, values);
}

Image read_tiff_picture(const std::string &path)
{
  if (const std::size_t n = tiff_pages(path); n != 1)
    throw UserError(path + " has " + std::to_string(n) +
                    " pages, but a plane body is one picture; save one page");
  const TiffImage tiff = read_tiff(path);
  return whole_numbers(path, tiff.width, tiff.height, tiff.values);
}
} // namespace

Image read_image(const std::string &path)
{
  const std::string bytes = read_file(path);
  const auto begins       = [&bytes](const std::string &with) {
    return bytes.compare(0, with.size(), with) == 0;
  };
  if (begins("\x93NUMPY"))
    return read_numpy(path, bytes);
  for (const char *kind : {"II*\0", "MM\0*", "II+\0", "MM\0+"})
    if (begins(std::string(kind, 4)))
      return read_tiff_picture(path);
  return is_png(bytes) ? read_png(path, bytes) : read_text(path, bytes);
}
} // namespace mesoslip
