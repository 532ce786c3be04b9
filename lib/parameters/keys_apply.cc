#include "base/errors.h"
#include "base/text.h"
#include "parameters/keys.h"

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <filesystem>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

std::string in_quotes(const std::string &text)
{
  return "'" + text + "'";
}

std::string parent_of(const std::string &path)
{
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string name_of(const std::string &path)
{
  return path.substr(path.rfind('/') + 1);
}

/** The keys and subsections that are declared, and what to say of one that is not. */
struct Declarations
{
  explicit Declarations(const std::vector<Key> &all_keys)
  {
    for (const Key &key : all_keys)
      {
        keys.push_back(key.path());
        for (std::string s = key.section; !s.empty(); s = parent_of(s))
          if (std::find(sections.begin(), sections.end(), s) == sections.end())
            sections.push_back(s);
      }
    std::sort(sections.begin(), sections.end());
  }

  bool has_section(const std::string &path) const
  {
    return path.empty() || std::binary_search(sections.begin(), sections.end(), path);
  }

  /** "there is no key 'Fracton' in 'Time step'; did you mean 'Fraction'?" */
  std::string unknown(const std::string &kind, const std::string &path) const
  {
    const std::string section = parent_of(path), name = name_of(path);
    if (!has_section(section))
      return unknown("subsection", section);
    std::vector<std::string> siblings, elsewhere;
    for (const std::string &other : kind == "key" ? keys : sections)
      if (parent_of(other) == section)
        siblings.push_back(name_of(other));
      else if (name_of(other) == name)
        elsewhere.push_back(other);
    const std::string start =
      "there is no " + kind + " " + in_quotes(name) +
      (section.empty() ? " at the top level" : " in " + in_quotes(section)) + "; ";
    const std::string meant =
      !elsewhere.empty() ? elsewhere.front() : nearest_word(name, siblings);
    if (!meant.empty())
      return start + "did you mean " + in_quotes(meant) + "?";
    if (siblings.empty())
      return start + "there are no " + kind + "s here, see --print-parameters";
    if (siblings.size() > 12)
      return start + "see --print-parameters";
    return start + "the " + kind + "s here are " + to_text(siblings);
  }

  std::vector<std::string> keys, sections;
};

/** "1e-4, 2" and "0.0001,2.0" are one value, "yes" and "true" as well. */
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
} // namespace

bool is_among(const std::string &path, const std::vector<std::string> &keys)
{
  return std::any_of(keys.begin(), keys.end(), [&](const std::string &key) {
    return key.back() == '/' ? path.rfind(key, 0) == 0 : path == key;
  });
}

void Keys::apply()
{
  const Declarations declared(keys);
  for (const RawParameters::Subsection &section : raw.subsections())
    if (!declared.has_section(section.path))
      throw UserError(raw.origin(section) + ": " +
                      declared.unknown("subsection", section.path));

  for (const RawParameters::Entry &entry : raw.entries())
    {
      const auto found         = index.find(entry.path);
      const auto renamed_key   = renames.find(entry.path);
      const auto renamed_value = renames.find(entry.path + " = " + entry.value);
      if (renamed_key != renames.end())
        throw UserError(raw.origin(entry) + ": the key " + entry.path + " is called " +
                        in_quotes(renamed_key->second) + " now; rename it");
      if (renamed_value != renames.end())
        throw UserError(raw.origin(entry) + ": " + entry.path + " = " + entry.value +
                        " is called " + in_quotes(renamed_value->second) + " now; set " +
                        entry.path + " = " + renamed_value->second);
      if (found == index.end())
        throw UserError(raw.origin(entry) + ": " + declared.unknown("key", entry.path));
      Key &key  = keys[found->second];
      key.value = entry.value;
      if (key.is_input && !entry.value.empty())
        key.value =
          fs::absolute(fs::path(entry.line == 0 ? "." : raw.folder()) / entry.value)
            .lexically_normal()
            .string();
      if (!key.accepts(key.value))
        throw UserError(raw.origin(entry) + ": " + entry.path + " is '" + key.value +
                        "' but must be " + key.allowed);
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
  std::sort(found.begin(), found.end()); // of one array: the order of the file
  return found;
}

void Keys::only_if(const bool used,
                   const std::vector<std::string> &paths,
                   const std::string &reason,
                   const std::string &remedy) const
{
  if (used || !reading)
    return;
  const auto entries = set_entries(paths);
  if (entries.empty())
    return;
  std::string others;
  for (std::size_t i = 1; i < entries.size(); ++i)
    others += (i == 1 ? "" : ", ") + entries[i]->path;
  throw UserError(
    raw.origin(*entries[0]) + ": " + entries[0]->path + " has no effect, as " + reason +
    (others.empty() ? "; remove it, or " : ", nor has " + others + "; remove them, or ") +
    remedy);
}
} // namespace mesoslip
