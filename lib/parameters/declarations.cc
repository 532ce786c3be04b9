#include "parameters/declarations.h"

#include "base/text.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
std::string parent_of(const std::string &path)
{
  const auto slash = path.rfind('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string name_of(const std::string &path)
{
  return path.substr(path.rfind('/') + 1);
}
} // namespace

std::string in_quotes(const std::string &text)
{
  return "'" + text + "'";
}

Declarations::Declarations(const std::vector<Key> &all_keys)
{
  for (const Key &key : all_keys)
    {
      keys.push_back(key.path());
      for (std::string s = key.section; !s.empty(); s = parent_of(s))
        sections.push_back(s);
    }
  std::sort(sections.begin(), sections.end());
  sections.erase(std::unique(sections.begin(), sections.end()), sections.end());
}

bool Declarations::has_section(const std::string &path) const
{
  return path.empty() || std::binary_search(sections.begin(), sections.end(), path);
}

std::string Declarations::unknown(const std::string &kind, const std::string &path) const
{
  if (("/" + path + "/").find("//") != std::string::npos)
    return in_quotes(path) + " has a slash too many";
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
  if (meant == name)
    return start + "it stands at the top level, behind an 'end' of " + in_quotes(section);
  if (!meant.empty())
    return start + "did you mean " + in_quotes(meant) + "?";
  if (siblings.empty())
    return start + "there are no " + kind + "s here, see --print-parameters";
  if (siblings.size() > 12)
    return start + "see --print-parameters";
  return start + "the " + kind + "s here are " + to_text(siblings) +
         (kind == "key" ? ""
                        : "; if it has the name of a phase or a probe, add that to "
                          "Phases/Names or Observation/Probes");
}
} // namespace mesoslip
