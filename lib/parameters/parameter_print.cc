#include "parameters/keys.h"

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <map>
#include <ostream>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Closes and opens subsections on the way from @p from to @p to. */
void change_section(std::ostream &out,
                    const std::vector<std::string> &from,
                    const std::vector<std::string> &to)
{
  std::size_t common = 0;
  while (common < from.size() && common < to.size() && from[common] == to[common])
    ++common;
  for (std::size_t depth = from.size(); depth > common; --depth)
    out << std::string(2 * (depth - 1), ' ') << "end\n";
  for (std::size_t depth = common; depth < to.size(); ++depth)
    out << '\n' << std::string(2 * depth, ' ') << "subsection " << to[depth] << '\n';
}
} // namespace

void print_parameters(const Keys &keys, std::ostream &out)
{
  std::vector<std::string> open;
  for (const Key &key : keys.all())
    {
      const auto section = dealii::Utilities::split_string_list(key.section, '/');
      change_section(out, open, section);
      open                     = section;
      const std::string indent = std::string(2 * open.size(), ' ');
      std::string text = key.meaning + (key.meaning.empty() ? "" : "; ") + key.allowed;
      if (key.value != key.default_value)
        text +=
          "; default: " + (key.default_value.empty() ? "nothing" : key.default_value);
      for (const std::string &line :
           dealii::Utilities::break_text_into_lines(text, 89 - indent.size() - 2))
        out << indent << "# " << line << '\n';
      out << indent << "set " << key.name << " =" << (key.value.empty() ? "" : " ")
          << boost::algorithm::replace_all_copy(key.value, "#", "\\#") << '\n';
    }
  change_section(out, open, {});
}

std::string canonical_parameters(const Keys &keys, const std::vector<std::string> &skip)
{
  std::string text;
  for (const Key &key : keys.all())
    if (!is_among(key.path(), skip))
      {
        // The content of a file counts, not where it lies; add it with
        // Digest::add_file().
        const bool file = key.is_input && !key.value.empty();
        text += key.path() + " = " + (file ? "<file>" : key.value) + "\n";
      }
  return text;
}

namespace
{
/** Key and value of each line. */
std::map<std::string, std::string> key_values(const std::string &text)
{
  std::map<std::string, std::string> values;
  std::istringstream in(text);
  std::string line;
  while (std::getline(in, line))
    {
      const auto equal = line.find(" = ");
      values[line.substr(0, equal)] =
        equal == std::string::npos ? "" : line.substr(equal + 3);
    }
  return values;
}
} // namespace

std::string parameter_differences(const std::string &now, const std::string &before)
{
  constexpr std::size_t shown = 5;
  std::vector<std::string> found;
  std::map<std::string, std::string> rest = key_values(before);
  const auto quoted                       = [](const std::string &value) {
    return value.empty() ? "empty" : value;
  };
  for (const auto &[key, value] : key_values(now))
    {
      const auto old = rest.find(key);
      if (old == rest.end())
        found.push_back(key + " is new (" + quoted(value) + ")");
      else if (old->second != value)
        found.push_back(key + " is " + quoted(value) + " instead of " +
                        quoted(old->second));
      if (old != rest.end())
        rest.erase(old);
    }
  for (const auto &[key, value] : rest)
    found.push_back(key + " is gone (" + quoted(value) + ")");

  std::string text;
  for (std::size_t i = 0; i < std::min(found.size(), shown); ++i)
    text += (i > 0 ? ", " : "") + found[i];
  if (found.size() > shown)
    text += " and " + std::to_string(found.size() - shown) + " more";
  return text;
}
} // namespace mesoslip
