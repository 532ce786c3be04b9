#include "exchange/run_conditions.h"

#include "io/hdf5_file.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** What a difference between two runs means. */
enum class Role
{
  load,   ///< another problem
  method, ///< the same problem, solved otherwise
  own     ///< of each run by itself
};

/** An attribute of /run; numbers have a unit, words have none. */
struct Condition
{
  const char *name;
  const char *unit;
  Role role;

  bool is_word() const
  {
    return *unit == '\0';
  }
};

const Condition known[] = {{"analysis", "", Role::load},
                           {"material", "", Role::own},
                           {"pressure", "Pa", Role::load},
                           {"pressure_history", "", Role::load},
                           {"pressure_ramp_time", "s", Role::load},
                           {"velocity", "m/s", Role::load},
                           {"velocity_history", "", Role::load},
                           {"velocity_ramp_time", "s", Role::load},
                           {"gap", "m", Role::load},
                           {"top", "", Role::load},
                           {"lateral_held", "", Role::load},
                           {"platen_mass", "kg/m", Role::load},
                           {"hold_from", "s", Role::load},
                           {"left_side", "", Role::load},
                           {"right_side", "", Role::load},
                           {"periodic", "", Role::load},
                           {"initial_velocity_x", "m/s", Role::load},
                           {"initial_velocity_y", "m/s", Role::load},
                           {"acceleration_x", "m/s^2", Role::load},
                           {"acceleration_y", "m/s^2", Role::load},
                           {"friction_coefficient", "-", Role::load},
                           {"coefficient_from", "", Role::method},
                           {"node_rule", "", Role::own},
                           {"friction_law", "", Role::method},
                           {"regularization_time", "s", Role::method},
                           {"slip_length", "m", Role::method},
                           {"reference_velocity", "m/s", Role::method},
                           {"beta2", "-", Role::method},
                           {"rayleigh_beta", "s", Role::method},
                           {"time_step", "s", Role::method},
                           {"steady_from", "s", Role::own},
                           {"steady_to", "s", Role::own},
                           {"limit_cycle_reached", "", Role::own}};

const char coefficient[] = "friction_coefficient";

/** Six digits, or all of them if @p other reads the same. */
std::string number_text(const double value, const std::optional<double> &other)
{
  const auto short_text = [](const double x) {
    std::ostringstream text;
    text << x;
    return text.str();
  };
  return other && short_text(*other) == short_text(value) ? to_text(value)
                                                          : short_text(value);
}

std::string value_text(const Condition &condition,
                       const RunConditions &run,
                       const RunConditions &other)
{
  if (condition.is_word())
    {
      const auto word = run.words.find(condition.name);
      return word == run.words.end() ? "none" : "'" + word->second + "'";
    }
  const auto value = run.number(condition.name);
  if (!value)
    return "none";
  const std::string unit = condition.unit;
  return number_text(*value, other.number(condition.name)) +
         (unit == "-" ? "" : " " + unit);
}

bool differ(const Condition &condition, const RunConditions &a, const RunConditions &b)
{
  if (condition.is_word())
    {
      const auto one = a.words.find(condition.name), two = b.words.find(condition.name);
      const bool there = one != a.words.end();
      return there != (two != b.words.end()) || (there && one->second != two->second);
    }
  const auto one = a.number(condition.name), two = b.number(condition.name);
  // Against coefficients of phases, which coefficient_from tells, a constant one is
  // right: it is what friction is homogenized to.
  if (condition.name == std::string(coefficient) && (!one || !two))
    return false;
  return one != two;
}
} // namespace

std::optional<double> RunConditions::number(const std::string &name) const
{
  const auto found = numbers.find(name);
  return found == numbers.end() ? std::nullopt : std::optional<double>(found->second);
}

void write_run_conditions(Hdf5File &file, const RunConditions &conditions)
{
  std::size_t written = 0;
  file.create_group("/run");
  for (const Condition &condition : known)
    if (condition.is_word() && conditions.words.count(condition.name) > 0)
      {
        file.write_attribute("/run", condition.name, conditions.words.at(condition.name));
        ++written;
      }
    else if (!condition.is_word() && conditions.numbers.count(condition.name) > 0)
      {
        file.write_attribute("/run", condition.name,
                             conditions.numbers.at(condition.name));
        ++written;
      }
  if (written != conditions.words.size() + conditions.numbers.size())
    throw std::logic_error(file.path() + ": /run has no attribute of some name");
}

std::optional<RunConditions> read_run_conditions(const Hdf5File &file)
{
  if (!file.exists("/run"))
    return std::nullopt;
  RunConditions conditions;
  for (const Condition &condition : known)
    if (!file.has_attribute("/run", condition.name))
      continue;
    else if (condition.is_word())
      conditions.words[condition.name] =
        file.read_attribute<std::string>("/run", condition.name);
    else
      conditions.numbers[condition.name] =
        file.read_attribute<double>("/run", condition.name);
  return conditions;
}

std::string ConditionDifference::text() const
{
  return name + " is " + first + " and " + second;
}

std::vector<ConditionDifference> condition_differences(const RunConditions &first,
                                                       const RunConditions &second)
{
  std::vector<ConditionDifference> differences;
  for (const Condition &condition : known)
    if (condition.role != Role::own && differ(condition, first, second))
      differences.push_back({condition.name, value_text(condition, first, second),
                             value_text(condition, second, first),
                             condition.role == Role::load});
  return differences;
}

std::string differences_text(const std::vector<ConditionDifference> &differences,
                             const bool of_load)
{
  std::string text;
  for (const ConditionDifference &difference : differences)
    if (difference.of_load == of_load)
      text += (text.empty() ? "" : ", ") + difference.text();
  return text;
}
} // namespace mesoslip
