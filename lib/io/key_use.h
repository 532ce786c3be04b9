#ifndef mesoslip_io_key_use_h
#define mesoslip_io_key_use_h

#include "io/raw_parameters.h"

#include <map>
#include <string>
#include <vector>

namespace dealii
{
class ParameterHandler;
}

namespace mesoslip
{
/**
 * Refuses keys that the values of other keys leave without effect, as the lists of an
 * orthotropic phase are when its Type is isotropic:
 * @code
 * use.only_with("Phases/a/Type", {"isotropic"}, {"Phases/a/Young modulus"});
 * @endcode
 * A key counts as set when the .prm or --set gives it another value than its default, so
 * that a file with all keys, as every run leaves it, is accepted again.
 */
class KeyUse
{
public:
  /** After @p raw has been applied to @p prm. */
  KeyUse(const dealii::ParameterHandler &prm, const RawParameters &raw);

  /** Value of a key now, as text. */
  const std::string &value(const std::string &path) const;

  /** Whether the .prm or --set names the key. */
  bool is_typed(const std::string &path) const;

  /**
   * @p keys are paths; "Section/" stands for all keys below. @throws UserError naming
   * those of them that are set unless the key @p decider has one of @p values.
   */
  void only_with(const std::string &decider,
                 const std::vector<std::string> &values,
                 const std::vector<std::string> &keys) const;

  /**
   * As only_with() when @p used is false. @p reason completes "has no effect, as ", and
   * @p remedy "remove it, or ".
   */
  void only_if(const bool used,
               const std::vector<std::string> &keys,
               const std::string &reason,
               const std::string &remedy) const;

private:
  /** The entries of @p keys that are set, in the order of the file. */
  std::vector<const RawParameters::Entry *>
  set_entries(const std::vector<std::string> &keys) const;

  const RawParameters &raw;
  std::map<std::string, std::string> values;               ///< of all keys
  std::map<std::string, const RawParameters::Entry *> set; ///< by path
};
} // namespace mesoslip

#endif
