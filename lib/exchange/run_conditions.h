#ifndef mesoslip_exchange_run_conditions_h
#define mesoslip_exchange_run_conditions_h

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mesoslip
{
class Hdf5File;

/**
 * Under what a contact_dynamics run was made: loads, supports, friction, damping, time
 * step, and its steady part, numbers in SI units and words by their names. The attributes
 * of /run in dynamics.h5; doc/file_formats.md lists them. What does not apply is absent.
 */
using RunConditions = std::map<std::string, std::variant<double, std::string>>;

/** The number of that name; nothing if it does not apply. */
std::optional<double> number_of(const RunConditions &conditions, const std::string &name);

/** Writes /run; all names must be known. */
void write_run_conditions(Hdf5File &file, const RunConditions &conditions);

/** Reads /run; nothing if the file is older and has none. @throws UserError */
std::optional<RunConditions> read_run_conditions(const Hdf5File &file);

/** One condition in which two runs differ. */
struct ConditionDifference
{
  std::string name;  ///< of the attribute
  std::string first; ///< value with unit in the first run; "none" where it does not apply
  std::string second; ///< the same in the second run
  /**
   * Whether results of the two runs cannot be compared: load, support or friction
   * coefficient differ. False for what is part of the method or adapted on purpose: time
   * step, beta, beta2, regularization, a coefficient for each phase against a constant.
   */
  bool of_load = false;
};

/** In what the two differ, in a fixed order; steady parts and bodies are not compared. */
std::vector<ConditionDifference> condition_differences(const RunConditions &first,
                                                       const RunConditions &second);

/** "pressure is 5e+06 Pa and 6e+06 Pa, ...", those with (@p of_load) or the others. */
std::string differences_text(const std::vector<ConditionDifference> &differences,
                             const bool of_load);
} // namespace mesoslip

#endif
