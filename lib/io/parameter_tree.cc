#include "io/declarations.h"
#include "io/errors.h"
#include "io/parameters.h"
#include "io/patterns.h"
#include "io/raw_parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <map>
#include <ostream>
#include <sstream>
#include <utility>

namespace mesoslip
{
void RawParameters::apply(dealii::ParameterHandler &prm) const
{
  const Declarations declared(prm);
  for (std::size_t i = 0; i < sections.size(); ++i)
    if (!declared.has_section(sections[i]))
      throw UserError(file_name + ":" + std::to_string(section_lines[i]) + ": " +
                      declared.unknown_section(sections[i]));

  for (const Entry &entry : all_entries)
    {
      const Declared *key = declared.find(entry.path);
      if (key == nullptr)
        throw UserError(origin(entry) + ": " + declared.unknown_key(entry.path));
      std::string value = entry.value;
      if (key->allowed == input_file_description)
        value = resolve_input_path(value, entry.line == 0 ? "." : folder());
      try
        {
          if (key->section.empty())
            prm.set(key->key, value);
          else
            {
              const ParameterSection inside(prm, key->section);
              prm.set(key->key, value);
            }
        }
      catch (const dealii::ExceptionBase &)
        {
          throw UserError(origin(entry) + ": " + entry.path + " is '" + value +
                          "' but must be " + pattern_in_words(key->allowed));
        }
    }
}

namespace
{
/** Prints @p text as comment lines of at most 90 columns. */
void print_comment(std::ostream &out, const std::string &indent, const std::string &text)
{
  std::istringstream words(text);
  std::string line = indent + "#", word;
  while (words >> word)
    {
      if (line.size() + 1 + word.size() > 90 && line.size() > indent.size() + 1)
        {
          out << line << '\n';
          line = indent + "#";
        }
      line += " " + word;
    }
  out << line << '\n';
}

std::vector<std::string> path_parts(const std::string &path)
{
  std::vector<std::string> parts;
  std::istringstream in(path);
  std::string part;
  while (std::getline(in, part, '/'))
    parts.push_back(part);
  return parts;
}

/** So that no comment begins in it. */
std::string with_escaped_hashes(const std::string &value)
{
  std::string text;
  for (const char c : value)
    text += c == '#' ? std::string("\\#") : std::string(1, c);
  return text;
}

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

void print_parameters(const dealii::ParameterHandler &prm, std::ostream &out)
{
  std::vector<std::string> open;
  for (const Declared &key : declared_keys(prm))
    {
      const std::vector<std::string> section = path_parts(key.section);
      change_section(out, open, section);
      open                     = section;
      const std::string indent = std::string(2 * open.size(), ' ');
      std::string text =
        key.meaning + (key.meaning.empty() ? "" : "; ") + pattern_in_words(key.allowed);
      if (key.value != key.default_value)
        text +=
          "; default: " + (key.default_value.empty() ? "nothing" : key.default_value);
      print_comment(out, indent, text);
      out << indent << "set " << key.key << " =" << (key.value.empty() ? "" : " ")
          << with_escaped_hashes(key.value) << '\n';
    }
  change_section(out, open, {});
}

std::string canonical_parameters(const dealii::ParameterHandler &prm,
                                 const std::vector<std::string> &skip)
{
  std::string text;
  const auto skipped = [&](const Declared &key) {
    return std::any_of(skip.begin(), skip.end(), [&](const std::string &s) {
      return s.back() == '/' ? key.path().rfind(s, 0) == 0 : key.path() == s;
    });
  };
  for (const Declared &key : declared_keys(prm))
    if (!skipped(key))
      {
        // The content of a file counts, not where it lies; add it with
        // Digest::add_file().
        const bool file = key.allowed == input_file_description && !key.value.empty();
        text += key.path() + " = " + (file ? "<file>" : key.value) + "\n";
      }
  return text;
}

namespace
{
/** Key and value of each line, in their order. */
std::vector<std::pair<std::string, std::string>> key_values(const std::string &text)
{
  std::vector<std::pair<std::string, std::string>> pairs;
  std::istringstream in(text);
  std::string line;
  while (std::getline(in, line))
    {
      const auto equal = line.find(" = ");
      pairs.emplace_back(line.substr(0, equal),
                         equal == std::string::npos ? "" : line.substr(equal + 3));
    }
  return pairs;
}
} // namespace

std::string parameter_differences(const std::string &now, const std::string &before)
{
  constexpr std::size_t shown = 5;
  std::vector<std::string> found;
  const auto new_pairs = key_values(now), old_pairs = key_values(before);
  std::map<std::string, std::string> rest(old_pairs.begin(), old_pairs.end());
  const auto quoted = [](const std::string &value) {
    return value.empty() ? "empty" : value;
  };
  for (const auto &[key, value] : new_pairs)
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
