#include "io/image.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "io/png_reader.h"

#include <algorithm>
#include <cctype>
#include <limits>
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
