#include "io/image.h"

#include "io/errors.h"
#include "io/files.h"
#include "io/text.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <png.h>
#include <sstream>

namespace mesoslip
{
namespace
{
bool is_png(const std::string &bytes)
{
  static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  return bytes.size() >= 8 && std::memcmp(bytes.data(), signature, 8) == 0;
}

/** Many programs write an alpha channel even where nothing is transparent. */
void require_opaque(const std::string &path, const std::string &bytes)
{
  png_image png = {};
  png.version   = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_image *)> guard(&png, png_image_free);
  png_image_begin_read_from_memory(&png, bytes.data(), bytes.size());
  png.format = PNG_FORMAT_GA;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0)
    throw UserError(path + ": this PNG is damaged or truncated (" + png.message + ")");
  for (std::size_t i = 1; i < pixels.size(); i += 2)
    if (pixels[i] != 255)
      throw UserError(path + " has transparent pixels, which belong to no phase; save it "
                             "without transparency");
}

/** All pixels as bytes R, G, B, the top row first. */
std::vector<unsigned char>
decode_png(const std::string &path, const std::string &bytes, Image &image)
{
  png_image png = {};
  png.version   = PNG_IMAGE_VERSION;
  // Releases what libpng holds, however we leave.
  const std::unique_ptr<png_image, void (*)(png_image *)> guard(&png, png_image_free);
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0)
    throw UserError(path + ": this PNG cannot be read (" + png.message + ")");
  const bool has_alpha = (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  if ((png.format & PNG_FORMAT_FLAG_LINEAR) != 0)
    throw UserError(path + " has 16 bits a channel; save it with 8");
  // Deflate shrinks to 1/1032 at best: nothing may make us ask for all memory.
  constexpr double most_pixels_per_byte = 8. * 1032.;
  if (!(static_cast<double>(png.width) * png.height <=
        most_pixels_per_byte * static_cast<double>(bytes.size())))
    throw UserError(path + ": this PNG claims " + std::to_string(png.width) + " x " +
                    std::to_string(png.height) + " pixels, more than its " +
                    std::to_string(bytes.size()) + " bytes can hold: it is damaged");
  png.format   = PNG_FORMAT_RGB;
  image.width  = png.width;
  image.height = png.height;
  std::vector<unsigned char> pixels(PNG_IMAGE_SIZE(png));
  if (png_image_finish_read(&png, nullptr, pixels.data(), 0, nullptr) == 0)
    throw UserError(path + ": this PNG is damaged or truncated (" + png.message + ")");
  if (has_alpha)
    require_opaque(path, bytes);
  return pixels;
}

Image read_png(const std::string &path, const std::string &bytes)
{
  Image image;
  const std::vector<unsigned char> pixels = decode_png(path, bytes, image);
  const std::size_t n_pixels              = pixels.size() / 3;
  bool grey                               = true;
  for (std::size_t i = 0; i < n_pixels; ++i)
    grey =
      grey && pixels[3 * i] == pixels[3 * i + 1] && pixels[3 * i] == pixels[3 * i + 2];

  image.values.resize(n_pixels);
  for (unsigned int y = 0; y < image.height; ++y)
    for (unsigned int x = 0; x < image.width; ++x)
      {
        const std::size_t row    = image.height - 1 - y; // the file begins at the top
        const unsigned char *rgb = &pixels[3 * (row * image.width + x)];
        image.values[static_cast<std::size_t>(y) * image.width + x] =
          grey ? rgb[0] : (rgb[0] << 16) + (rgb[1] << 8) + rgb[2];
      }
  return image;
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
      values.push_back(static_cast<int>(value));
    }
  return values;
}

Image read_text(const std::string &path, const std::string &text)
{
  if (text.find('\0') != std::string::npos)
    throw UserError(path + " is neither a PNG nor a text file with whole numbers");
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
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    image.values.insert(image.values.end(), row->begin(), row->end());
  return image;
}
} // namespace

std::vector<int> Image::distinct_values() const
{
  std::vector<int> distinct = values;
  std::sort(distinct.begin(), distinct.end());
  distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
  return distinct;
}

Image read_image(const std::string &path)
{
  const std::string bytes = read_file(path);
  return is_png(bytes) ? read_png(path, bytes) : read_text(path, bytes);
}
} // namespace mesoslip
