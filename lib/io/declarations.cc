#include "io/declarations.h"

#include "io/parameters.h"
#include "io/text.h"

#include <deal.II/base/parameter_handler.h>

#include <boost/property_tree/ptree.hpp>

namespace mesoslip
{
namespace
{
using Tree = boost::property_tree::ptree;

/**
 * deal.II shows its tree of keys, with documentation and patterns, only to archives and
 * as text. This one keeps the way to the tree; printing and parsing took twenty times as
 * long.
 */
class TreeArchive
{
public:
  template <typename T>
  TreeArchive &operator&(const T &)
  {
    return *this;
  }
  TreeArchive &operator&(const Tree &entries)
  {
    tree = &entries;
    return *this;
  }

  const Tree *tree = nullptr;
};

/** deal.II keeps what is no letter or digit as _ and its code in two hexadecimal digits.
 */
std::string demangled(const std::string &name)
{
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i)
    if (name[i] == '_' && i + 2 < name.size())
      {
        text += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
        i += 2;
      }
    else
      text += name[i];
  return text;
}

bool is_key(const Tree &node)
{
  return node.count("value") > 0 && node.count("pattern") > 0;
}

void collect(const Tree &node, const std::string &section, std::vector<Declared> &keys)
{
  for (const auto &[name, child] : node)
    if (is_key(child))
      keys.push_back({section, demangled(name), child.get<std::string>("value"),
                      child.get<std::string>("default_value"),
                      child.get<std::string>("documentation", ""),
                      child.get<std::string>("pattern_description")});
  for (const auto &[name, child] : node)
    if (!child.empty() && !is_key(child) && child.count("alias") == 0)
      collect(child, (section.empty() ? "" : section + "/") + demangled(name), keys);
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
  TreeArchive archive;
  prm.save(archive, 0);
  std::vector<Declared> keys;
  collect(*archive.tree, "", keys);
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
