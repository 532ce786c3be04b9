#ifndef mesoslip_exchange_run_conditions_h
#define mesoslip_exchange_run_conditions_h

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
class Hdf5File;

/**
 * Under what a contact_dynamics run was made: loads, supports, friction, damping, time
 * step, and its steady part. The attributes of /run in dynamics.h5; doc/file_formats.md
 * lists them with their units. What does not apply is absent.
 */
struct RunConditions
{
  std::map<std::string, double> numbers;    ///< SI units
  std::map<std::string, std::string> words; ///< choices of the parameters

  /** Nothing if there is no such number. */
  std::optional<double> number(const std::string &name) const;
};

/** Writes /run. @throws std::logic_error for a name that is not known. */
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

  /** "pressure is 5e+06 Pa and 6e+06 Pa". */
  std::string text() const;
};

/** In what the two differ, in a fixed order; steady parts and bodies are not compared. */
std::vector<ConditionDifference> condition_differences(const RunConditions &first,
                                                       const RunConditions &second);

/** The texts of those with (@p of_load) or of the others, joined by commas. */
std::string differences_text(const std::vector<ConditionDifference> &differences,
                             const bool of_load);
} // namespace mesoslip

#endif
