#include "base/text.h"

#include <boost/algorithm/string.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace mesoslip
{
namespace
{
template <typename Number>
bool parse_all(const std::string &text, Number &value)
{
  const char *begin = text.data();
  const char *end   = begin + text.size();
  if (end - begin > 1 && *begin == '+' && begin[1] != '-')
    ++begin;
  const auto result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end;
}
} // namespace

bool parse_number(const std::string &text, double &value)
{
  return parse_all(text, value) && std::isfinite(value);
}

bool has_usable_size(const double value)
{
  constexpr double smallest = 1e-100, largest = 1e100;
  const double size = std::fabs(value);
  return size == 0. || (size >= smallest && size <= largest);
}

bool parse_number(const std::string &text, long &value)
{
  return parse_all(text, value);
}

bool is_utf8(const std::string &text)
{
  try
    {
      nlohmann::json(text).dump();
      return true;
    }
  catch (const nlohmann::json::type_error &)
    {
      return false;
    }
}

std::string trimmed(const std::string &text)
{
  const char *const blanks = " \t\n\v\f\r";
  const std::size_t first  = text.find_first_not_of(blanks);
  return first == std::string::npos
           ? std::string()
           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

namespace
{
/** Levenshtein distance. */
std::size_t edit_distance(const std::string &a, const std::string &b)
{
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t(0));
  for (std::size_t i = 0; i < a.size(); ++i)
    {
      std::size_t diagonal = row[0];
      row[0]               = i + 1;
      for (std::size_t j = 0; j < b.size(); ++j)
        {
          const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
          diagonal                   = row[j + 1];
          row[j + 1]                 = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
  return row.back();
}
} // namespace

std::string plain_lines(const std::string &text)
{
  const std::string mark = "\xef\xbb\xbf";
  std::string lines;
  lines.reserve(text.size());
  for (std::size_t i = text.rfind(mark, 0) == 0 ? mark.size() : 0; i < text.size(); ++i)
    if (text[i] != '\r')
      lines += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      lines += '\n';
  return lines;
}

std::string nearest_word(const std::string &word,
                         const std::vector<std::string> &candidates)
{
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2) + 1;
  for (const std::string &candidate : candidates)
    {
      const std::size_t distance =
        edit_distance(boost::algorithm::to_lower_copy(word),
                      boost::algorithm::to_lower_copy(candidate));
      if (distance < least)
        {
          least   = distance;
          nearest = candidate;
        }
    }
  return nearest;
}

std::string to_text(const double value)
{
  char text[32];
  const auto result = std::to_chars(text, text + sizeof(text), value);
  return std::string(text, result.ptr);
}

std::string to_text(const std::vector<double> &values)
{
  std::vector<std::string> words;
  for (const double value : values)
    words.push_back(to_text(value));
  return to_text(words);
}

std::string to_text(const std::vector<std::string> &words)
{
  return boost::algorithm::join(words, ", ");
}

std::vector<std::string> split_list(const std::string &text)
{
  std::vector<std::string> items;
  if (trimmed(text).empty())
    return items;
  boost::algorithm::split(items, text, boost::algorithm::is_any_of(","));
  for (std::string &item : items)
    item = trimmed(item);
  return items;
}
} // namespace mesoslip
