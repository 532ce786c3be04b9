#ifndef mesoslip_io_declarations_h
#define mesoslip_io_declarations_h

#include <set>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
/** A key of a ParameterHandler with all that is known about it. */
struct Declared
{
  std::string section;       ///< path, empty at the top
  std::string key;           ///< name within the section
  std::string value;         ///< text now
  std::string default_value; ///< text without a .prm
  std::string meaning;       ///< ends with the unit in brackets
  /** Description of its pattern; pattern_in_words() makes it readable. */
  std::string allowed;

  /** "Section/Sub section/Key". */
  std::string path() const
  {
    return section.empty() ? key : section + "/" + key;
  }
};

/** All keys, those of a section before its subsections, in the order of declaration. */
std::vector<Declared> declared_keys(const dealii::ParameterHandler &prm);

/** What is declared, arranged for questions about what is not. */
class Declarations
{
public:
  /** All that @p prm declares. */
  explicit Declarations(const dealii::ParameterHandler &prm);

  /** nullptr if there is no such key. */
  const Declared *find(const std::string &path) const;

  /** Whether something is declared in it or below. */
  bool has_section(const std::string &path) const;

  /** "there is no subsection 'Tme step'; did you mean 'Time step'?" */
  std::string unknown_section(const std::string &path) const;

  /** "there is no key 'Fracton' in 'Time step'; did you mean 'Fraction'?" */
  std::string unknown_key(const std::string &path) const;

private:
  std::vector<std::string> sections_named(const std::string &name) const;

  std::vector<Declared> keys;
  std::set<std::string> sections;
};
} // namespace mesoslip

#endif
