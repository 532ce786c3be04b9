#include "io/declarations.h"

#include "io/parameters.h"
#include "io/text.h"

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>
#include <sstream>

namespace mesoslip
{
namespace
{
void collect(const nlohmann::ordered_json &node,
             const std::string &section,
             std::vector<Declared> &keys)
{
  const auto is_key = [](const nlohmann::ordered_json &child) {
    return child.contains("value") && child["value"].is_string() &&
           child.contains("pattern");
  };
  for (const auto &[name, child] : node.items())
    if (is_key(child))
      keys.push_back({section, name, child["value"].get<std::string>(),
                      child["default_value"].get<std::string>(),
                      child.value("documentation", ""),
                      child["pattern_description"].get<std::string>()});
  for (const auto &[name, child] : node.items())
    if (child.is_object() && !is_key(child) && !child.contains("alias"))
      collect(child, (section.empty() ? "" : section + "/") + name, keys);
}

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

std::string place(const std::string &section)
{
  return section.empty() ? " at the top level" : " in " + in_quotes(section);
}

/** The most helpful continuation of "there is no ...". */
std::string advice(const std::string &word,
                   const std::vector<std::string> &siblings,
                   const std::vector<std::string> &elsewhere,
                   const char *kind)
{
  if (!elsewhere.empty())
    return "; did you mean " + in_quotes(elsewhere.front()) + "?";
  const std::string nearest = nearest_word(word, siblings);
  if (!nearest.empty())
    return "; did you mean " + in_quotes(nearest) + "?";
  if (siblings.empty())
    return std::string("; there are no ") + kind + " here, see --print-parameters";
  if (siblings.size() > 12)
    return "; see --print-parameters";
  return std::string("; the ") + kind + " here are " + to_text(siblings);
}

} // namespace

std::vector<Declared> declared_keys(const dealii::ParameterHandler &prm)
{
  // The only access to documentation and patterns that deal.II gives.
  std::stringstream text;
  prm.print_parameters(text, dealii::ParameterHandler::JSON |
                               dealii::ParameterHandler::KeepDeclarationOrder);
  std::vector<Declared> keys;
  collect(nlohmann::ordered_json::parse(text), "", keys);
  return keys;
}

Declarations::Declarations(const dealii::ParameterHandler &prm)
  : keys(declared_keys(prm))
{
  for (const Declared &key : keys)
    for (std::string s = key.section; !s.empty(); s = parent_of(s))
      sections.insert(s);
}

const Declared *Declarations::find(const std::string &path) const
{
  for (const Declared &key : keys)
    if (key.path() == path)
      return &key;
  return nullptr;
}

bool Declarations::has_section(const std::string &path) const
{
  return path.empty() || sections.count(path) > 0;
}

std::string Declarations::unknown_section(const std::string &path) const
{
  const std::string parent = parent_of(path);
  if (!has_section(parent))
    return unknown_section(parent);
  std::vector<std::string> siblings;
  for (const std::string &section : sections)
    if (parent_of(section) == parent)
      siblings.push_back(name_of(section));
  return "there is no subsection " + in_quotes(name_of(path)) + place(parent) +
         advice(name_of(path), siblings, sections_named(name_of(path)), "subsections");
}

std::string Declarations::unknown_key(const std::string &path) const
{
  const std::string section = parent_of(path);
  if (!has_section(section))
    return unknown_section(section);
  std::vector<std::string> siblings, elsewhere;
  for (const Declared &key : keys)
    if (key.section == section)
      siblings.push_back(key.key);
    else if (key.key == name_of(path))
      elsewhere.push_back(key.path());
  return "there is no key " + in_quotes(name_of(path)) + place(section) +
         advice(name_of(path), siblings, elsewhere, "keys");
}

std::vector<std::string> Declarations::sections_named(const std::string &name) const
{
  std::vector<std::string> found;
  for (const std::string &section : sections)
    if (name_of(section) == name)
      found.push_back(section);
  return found;
}

} // namespace mesoslip
