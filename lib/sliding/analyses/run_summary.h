#ifndef mesoslip_sliding_analyses_run_summary_h
#define mesoslip_sliding_analyses_run_summary_h

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace mesoslip
{
/** summary.json of a finished run. Errors name the key that gave the folder, and the
 * file. */
class RunSummary
{
public:
  /** @p key: "Friction homogenization/Heterogeneous run". @throws UserError */
  RunSummary(const std::string &key, const std::string &folder);

  /** @throws UserError unless the run was a contact_dynamics @p analysis. */
  void require_analysis(const std::string &analysis) const;

  /** Nothing if the key is missing or null. */
  std::optional<double> find_number(const std::string &name) const;

  /** @p missing says what a missing number means and what to do. @throws UserError */
  double number(const std::string &name, const std::string &missing) const;

  /** A text of the file, empty when there is none of that name. */
  std::string text(const std::string &name) const;

  /** The numbers of an object such as phase_contact_pressures; empty if it is missing. */
  std::map<std::string, double> numbers(const std::string &name) const;

  /** Path of another file in the folder. */
  std::string file(const std::string &name) const;

  /** The folder of the run. */
  const std::string &folder() const
  {
    return path;
  }

private:
  const std::string key;
  std::string path;
  nlohmann::json json;
};
} // namespace mesoslip

#endif
