#include "base/errors.h"
#include "base/text.h"
#include "parameters/keys.h"

#include <algorithm>
#include <set>

namespace mesoslip
{
namespace
{
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

/** What is declared, arranged for questions about what is not. */
class Declarations
{
public:
  explicit Declarations(const std::vector<Key> &all_keys)
    : keys(all_keys)
  {
    for (const Key &key : keys)
      for (std::string s = key.section; !s.empty(); s = parent_of(s))
        sections.insert(s);
  }

  bool has_section(const std::string &path) const
  {
    return path.empty() || sections.count(path) > 0;
  }

  /** "there is no subsection 'Tme step'; did you mean 'Time step'?" */
  std::string unknown_section(const std::string &path) const
  {
    const std::string parent = parent_of(path), name = name_of(path);
    if (!has_section(parent))
      return unknown_section(parent);
    std::vector<std::string> siblings, elsewhere;
    for (const std::string &section : sections)
      {
        if (parent_of(section) == parent)
          siblings.push_back(name_of(section));
        if (name_of(section) == name)
          elsewhere.push_back(section);
      }
    return unknown("subsection", name, parent, siblings, elsewhere);
  }

  /** "there is no key 'Fracton' in 'Time step'; did you mean 'Fraction'?" */
  std::string unknown_key(const std::string &path) const
  {
    const std::string section = parent_of(path), name = name_of(path);
    if (!has_section(section))
      return unknown_section(section);
    std::vector<std::string> siblings, elsewhere;
    for (const Key &key : keys)
      if (key.section == section)
        siblings.push_back(key.name);
      else if (key.name == name)
        elsewhere.push_back(key.path());
    return unknown("key", name, section, siblings, elsewhere);
  }

private:
  static std::string unknown(const std::string &kind,
                             const std::string &name,
                             const std::string &section,
                             const std::vector<std::string> &siblings,
                             const std::vector<std::string> &elsewhere)
  {
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

  const std::vector<Key> &keys;
  std::set<std::string> sections;
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

void Keys::apply()
{
  const Declarations declared(keys);
  for (const RawParameters::Subsection &section : raw.subsections())
    if (!declared.has_section(section.path))
      throw UserError(raw.origin(section) + ": " +
                      declared.unknown_section(section.path));

  for (const RawParameters::Entry &entry : raw.entries())
    {
      const auto found = index.find(entry.path);
      if (found == index.end())
        throw UserError(raw.origin(entry) + ": " + declared.unknown_key(entry.path));
      Key &key  = keys[found->second];
      key.value = key.is_input ? resolve_input_path(entry.value,
                                                    entry.line == 0 ? "." : raw.folder())
                               : entry.value;
      if (!key.accepts(key.value))
        throw UserError(raw.origin(entry) + ": " + entry.path + " is '" + key.value +
                        "' but must be " + key.allowed);
      if (!same_value(key.value, key.default_value))
        set[entry.path] = &entry;
    }
  reading = true;
}

void Keys::only_with(const std::string &decider,
                     const std::vector<std::string> &values,
                     const std::vector<std::string> &paths) const
{
  const std::string &now = value(decider);
  std::string choices;
  for (const std::string &choice : values)
    choices += (choices.empty() ? "" : " or ") + choice;
  only_if(std::find(values.begin(), values.end(), now) != values.end(), paths,
          decider + " is '" + now + "'", "set " + decider + " = " + choices);
}

std::vector<const RawParameters::Entry *>
Keys::set_entries(const std::vector<std::string> &paths) const
{
  std::vector<const RawParameters::Entry *> found;
  for (const std::string &path : paths)
    for (auto entry = set.lower_bound(path);
         entry != set.end() &&
         (path.back() == '/' ? entry->first.rfind(path, 0) == 0 : entry->first == path);
         ++entry)
      found.push_back(entry->second);
  std::sort(found.begin(), found.end()); // of one array: the order of the file
  return found;
}

void Keys::only_if(const bool used,
                   const std::vector<std::string> &paths,
                   const std::string &reason,
                   const std::string &remedy) const
{
  if (used)
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
