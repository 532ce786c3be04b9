#ifndef mesoslip_parameters_declarations_h
#define mesoslip_parameters_declarations_h

#include "parameters/keys.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** The declared keys and subsections, and suggestions for undeclared names. */
class Declarations
{
public:
  /** @p all_keys are all keys that a program binds. */
  explicit Declarations(const std::vector<Key> &all_keys);

  /** Whether there is a subsection with this path ("Friction/Slip law"); the top level is "". */
  bool has_section(const std::string &path) const;

  /** Message on an undeclared @p kind ("key" or "subsection"): "there is no key 'Fracton'
   * in 'Time step'; did you mean 'Fraction'?" */
  std::string unknown(const std::string &kind, const std::string &path) const;

private:
  std::vector<std::string> keys, sections; ///< paths; sections are sorted
};

/** The text in single quotes. */
std::string in_quotes(const std::string &text);
} // namespace mesoslip

#endif
