#include "base/errors.h"
#include "base/text.h"
#include "parameters/declarations.h"
#include "parameters/keys.h"

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/replace.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <ostream>
#include <sstream>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** Whether texts mean the same value: "1e-4, 2" and "0.0001,2.0", or "yes" and "true". */
bool same_value(const std::string &a, const std::string &b)
{
  static const auto plain = [](const std::string &text) -> std::string {
    if (text == "yes" || text == "on")
      return "true";
    if (text == "no" || text == "off")
      return "false";
    double number;
    return parse_number(text, number) ? to_text(number) : text;
  };
  const std::vector<std::string> left = split_list(a), right = split_list(b);
  return std::equal(
    left.begin(), left.end(), right.begin(), right.end(),
    [](const std::string &x, const std::string &y) { return plain(x) == plain(y); });
}

/** Advice on writing the numbers that a rejected value seems to mean. */
std::string advice(const Key &key)
{
  const std::string digits = "0123456789", &text = key.value;
  if (key.allowed.find("number") == std::string::npos)
    return "";
  const auto comma = text.find(',');
  if (text.find('.') == std::string::npos && comma != std::string::npos && comma > 0 &&
      digits.find(text[comma - 1]) != std::string::npos && comma + 1 < text.size() &&
      digits.find(text[comma + 1]) != std::string::npos)
    return "; write decimals with a point";
  const auto last = text.find_last_of(digits + ".");
  const std::string rest =
    last == std::string::npos ? "" : trimmed(text.substr(last + 1));
  if (!rest.empty() && std::isalpha(static_cast<unsigned char>(rest[0])) != 0)
    return "; write numbers without a unit, such as 30e9 for 30 GPa";
  const std::vector<std::string> items = split_list(text);
  const auto is_unusable               = [](const std::string &item) {
    double number = 0.;
    return parse_number(item, number) && !has_usable_size(number);
  };
  return std::any_of(items.begin(), items.end(), is_unusable)
           ? std::string("; ") + usable_sizes
           : "";
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

bool is_among(const std::string &path, const std::vector<std::string> &keys)
{
  return std::any_of(keys.begin(), keys.end(), [&](const std::string &key) {
    return key.back() == '/' ? path.rfind(key, 0) == 0 : path == key;
  });
}

std::vector<std::string> Key::inputs() const
{
  if (!is_input || value.empty())
    return {};
  if (!is_list)
    return {value};
  if (value.front() != '/')
    return split_list(value);
  // Splits paths as joined by apply(): folders may have commas in their names.
  std::vector<std::string> paths;
  for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 2)
    paths.push_back(value.substr(begin, (end = value.find(", /", begin)) - begin));
  return paths;
}

/** New name of @p path, with "Section/" for a subsection; empty if it was not renamed. */
std::string Keys::new_name(const std::string &path) const
{
  const auto found = renames.find(path);
  if (found != renames.end())
    return found->second;
  for (const auto &[old, now] : renames)
    if (old.back() == '/' && path.rfind(old, 0) == 0)
      return now + path.substr(old.size());
  return "";
}

void Keys::apply()
{
  const Declarations declared(keys);
  for (const RawParameters::Entry &section : raw.subsections())
    if (const std::string now = new_name(section.path + "/"); !now.empty())
      throw UserError(RawParameters::origin(section) + ": the subsection " +
                      section.path + " is called " +
                      in_quotes(now.substr(0, now.size() - 1)) + " now; rename it");
    else if (!declared.has_section(section.path))
      throw UserError(RawParameters::origin(section) + ": " +
                      declared.unknown("subsection", section.path));

  for (const RawParameters::Entry &entry : raw.entries())
    {
      const std::string where  = RawParameters::origin(entry) + ": ";
      const auto found         = index.find(entry.path);
      const auto renamed_value = renames.find(entry.path + " = " + entry.value);
      if (const std::string now = new_name(entry.path); !now.empty())
        throw UserError(where + "the key " + entry.path + " is called " + in_quotes(now) +
                        " now; rename it");
      if (renamed_value != renames.end())
        throw UserError(where + entry.path + " = " + entry.value + " is called " +
                        in_quotes(renamed_value->second) + " now; set " + entry.path +
                        " = " + renamed_value->second);
      if (found == index.end())
        throw UserError(where + declared.unknown("key", entry.path));
      Key &key  = keys[found->second];
      key.value = entry.value;
      if (const auto inputs = key.is_list ? split_list(entry.value) : key.inputs();
          !inputs.empty())
        {
          key.value.clear();
          if (std::find(inputs.begin(), inputs.end(), "") != inputs.end())
            throw UserError(where + entry.path +
                            " has a comma without a name; remove it");
          for (const std::string &input : inputs)
            key.value += (key.value.empty() ? "" : ", ") +
                         fs::absolute(RawParameters::folder(entry) / fs::path(input))
                           .lexically_normal()
                           .string();
        }
      if (!key.accepts(key.value))
        throw UserError(where + entry.path + " is '" + key.value + "' but must be " +
                        key.allowed + advice(key));
      if (!same_value(key.value, key.default_value))
        set[entry.path] = &entry;
    }
  reading = true;
}

void Keys::require(const bool holds,
                   const std::string &key,
                   const std::string &what) const
{
  if (reading && !holds)
    throw UserError(path(key) + ": " + what);
}

void Keys::only_with(const std::string &decider,
                     const std::vector<std::string> &values,
                     const std::vector<std::string> &paths) const
{
  if (!reading)
    return;
  const std::string full = path(decider), &now = value(full);
  only_if(std::find(values.begin(), values.end(), now) != values.end(), paths,
          full + " is '" + now + "'",
          "set " + full + " = " + boost::algorithm::join(values, " or "));
}

std::vector<const RawParameters::Entry *>
Keys::set_entries(const std::vector<std::string> &paths) const
{
  std::vector<std::string> full;
  for (const std::string &relative : paths)
    full.push_back(path(relative));
  std::vector<const RawParameters::Entry *> found;
  for (const auto &[name, entry] : set)
    if (is_among(name, full))
      found.push_back(entry);
  std::sort(found.begin(), found.end()); // pointers into one array: file order
  return found;
}

void Keys::only_if(const bool used,
                   const std::vector<std::string> &paths,
                   const std::string &reason,
                   const std::string &remedy) const
{
  if (used || !reading || raw.ignores_unused())
    return;
  const auto entries = set_entries(paths);
  if (entries.empty())
    return;
  std::string others;
  for (std::size_t i = 1; i < entries.size(); ++i)
    others += (i == 1 ? "" : ", ") + entries[i]->path;
  throw UserError(
    RawParameters::origin(*entries[0]) + ": " + entries[0]->path + " has no effect, as " +
    reason + (others.empty() ? "; remove it" : ", nor has " + others + "; remove them") +
    (remedy.empty() ? "" : ", or " + remedy));
}

namespace
{
/** Meaning, allowed values and default as comments. */
void print_meaning(const Key &key, const std::string &indent, std::ostream &out)
{
  std::string text = key.meaning + (key.meaning.empty() ? "" : "; ") + key.allowed;
  if (key.value != key.default_value)
    text += "; default: " + (key.default_value.empty() ? "nothing" : key.default_value);
  for (const std::string &line :
       dealii::Utilities::break_text_into_lines(text, 89 - indent.size() - 2))
    out << indent << "# " << line << '\n';
}

/** Prints the keys for which @p wanted is true. */
template <typename Wanted>
void print_keys(const Keys &keys,
                std::ostream &out,
                const bool with_meaning,
                const Wanted &wanted)
{
  std::vector<std::string> open;
  for (const Key &key : keys.all())
    {
      if (!wanted(key))
        continue;
      const auto section = dealii::Utilities::split_string_list(key.section, '/');
      change_section(out, open, section);
      open                     = section;
      const std::string indent = std::string(2 * open.size(), ' ');
      if (with_meaning)
        print_meaning(key, indent, out);
      out << indent << "set " << key.name << " =" << (key.value.empty() ? "" : " ")
          << boost::algorithm::replace_all_copy(key.value, "#", "\\#") << '\n';
    }
  change_section(out, open, {});
}
} // namespace

void print_parameters(const Keys &keys, std::ostream &out)
{
  print_keys(keys, out, true, [](const Key &) { return true; });
}

void print_given(const Keys &keys,
                 std::ostream &out,
                 const std::vector<std::string> &skip)
{
  print_keys(keys, out, false, [&](const Key &key) {
    return (key.section.empty() || keys.is_typed(key.path()) ||
            key.value != key.default_value) &&
           !is_among(key.path(), skip);
  });
}

std::string canonical_parameters(const Keys &keys, const std::vector<std::string> &skip)
{
  std::string text;
  for (const Key &key : keys.all())
    if (!is_among(key.path(), skip))
      {
        // Files count by their content, not their path; add it with Digest::add_file().
        std::string value = key.value;
        if (const std::size_t n = key.inputs().size(); n > 0)
          value = n == 1 ? "<file>" : "<" + std::to_string(n) + " files>";
        text += key.path() + " = " + value + "\n";
      }
  return text;
}

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
