#include "io/errors.h"
#include "io/parameters.h"
#include "io/patterns.h"
#include "io/raw_parameters.h"

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <sstream>

namespace mesoslip
{
namespace
{
/** A declared key. */
struct Declared
{
  std::string section;
  std::string key;
  std::string value;
  std::string default_value;
  std::string meaning;
  std::string allowed;

  std::string path() const
  {
    return section.empty() ? key : section + "/" + key;
  }
};

/** Undoes deal.II's coding of names: "_20" is a blank. */
std::string unmangled(const std::string &name)
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
      keys.push_back({section, unmangled(name), child["value"].get<std::string>(),
                      child["default_value"].get<std::string>(),
                      child.value("documentation", ""),
                      child["pattern_description"].get<std::string>()});
  for (const auto &[name, child] : node.items())
    if (child.is_object() && !is_key(child) && !child.contains("alias"))
      collect(child, (section.empty() ? "" : section + "/") + unmangled(name), keys);
}

/** All keys, those of a section before its subsections, in the order of declaration. */
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
  explicit Declarations(const dealii::ParameterHandler &prm)
    : keys(declared_keys(prm))
  {
    for (const Declared &key : keys)
      for (std::string s = key.section; !s.empty(); s = parent_of(s))
        sections.insert(s);
  }

  const Declared *find(const std::string &path) const
  {
    for (const Declared &key : keys)
      if (key.path() == path)
        return &key;
    return nullptr;
  }

  bool has_section(const std::string &path) const
  {
    return path.empty() || sections.count(path) > 0;
  }

  /** "there is no subsection 'Tme step'; did you mean 'Time step'?" */
  std::string unknown_section(const std::string &path) const
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

  std::string unknown_key(const std::string &path) const
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

private:
  static std::string place(const std::string &section)
  {
    return section.empty() ? " at the top level" : " in " + in_quotes(section);
  }

  std::vector<std::string> sections_named(const std::string &name) const
  {
    std::vector<std::string> found;
    for (const std::string &section : sections)
      if (name_of(section) == name)
        found.push_back(section);
    return found;
  }

  /** The most helpful continuation of "there is no ...". */
  static std::string advice(const std::string &word,
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

  std::vector<Declared> keys;
  std::set<std::string> sections;
};
} // namespace

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
          throw UserError(origin(entry) + ": " + in_quotes(entry.path) + " is " +
                          in_quotes(value) + " but must be " +
                          pattern_in_words(key->allowed));
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
          << key.value << '\n';
    }
  change_section(out, open, {});
}

std::string canonical_parameters(const dealii::ParameterHandler &prm,
                                 const std::vector<std::string> &skip)
{
  std::string text;
  for (const Declared &key : declared_keys(prm))
    if (std::find(skip.begin(), skip.end(), key.path()) == skip.end())
      {
        // The content of a file counts, not where it lies; add it with
        // Digest::add_file().
        const bool file = key.allowed == input_file_description && !key.value.empty();
        text += key.path() + " = " + (file ? "<file>" : key.value) + "\n";
      }
  return text;
}
} // namespace mesoslip
