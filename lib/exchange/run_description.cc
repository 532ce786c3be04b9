#include "exchange/run_description.h"

#include "io/hdf5_file.h"
#include "parameters/parameters.h"

#include <deal.II/base/exceptions.h>

#include <sstream>

namespace mesoslip
{
namespace
{
/** Meaning of a difference between two runs. */
enum class Role
{
  load,   ///< different problems
  method, ///< same problem, different method
  own     ///< specific to each run
};

/** An attribute of /run; numbers have a unit, words do not. */
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
                           {"flat_direction_x", "-", Role::load},
                           {"flat_direction_y", "-", Role::load},
                           {"gap", "m", Role::load},
                           {"normal_stiffness", "Pa/m", Role::load},
                           {"normal_exponent", "-", Role::load},
                           {"normal_stiffness_at", "Pa", Role::load},
                           {"tangential_stiffness", "Pa/m", Role::load},
                           {"flat_profile", "", Role::load},
                           {"counter_body", "", Role::load},
                           {"contact_side", "", Role::load},
                           {"top", "", Role::load},
                           {"lateral_held", "", Role::load},
                           {"platen_mass", "kg/m", Role::load},
                           {"hold_from", "s", Role::load},
                           {"left_side", "", Role::load},
                           {"right_side", "", Role::load},
                           {"periodic", "", Role::load},
                           {"periodic_in_y", "", Role::load},
                           {"initial_velocity_x", "m/s", Role::load},
                           {"initial_velocity_y", "m/s", Role::load},
                           {"initial_velocity_z", "m/s", Role::load},
                           {"acceleration_x", "m/s^2", Role::load},
                           {"acceleration_y", "m/s^2", Role::load},
                           {"acceleration_z", "m/s^2", Role::load},
                           {"supports", "", Role::load},
                           {"held_in_x", "", Role::load},
                           {"held_in_y", "", Role::load},
                           {"held_in_z", "", Role::load},
                           {"friction_coefficient", "-", Role::load},
                           {"coefficient_from", "", Role::method},
                           {"node_rule", "", Role::own},
                           {"coefficient_law", "", Role::load},
                           {"normal_stress", "", Role::method},
                           {"friction_law", "", Role::method},
                           {"regularization_time", "s", Role::method},
                           {"slip_length", "m", Role::method},
                           {"reference_velocity", "m/s", Role::method},
                           {"beta2", "-", Role::method},
                           {"rayleigh_alpha", "1/s", Role::method},
                           {"rayleigh_beta", "s", Role::method},
                           {"damping_by_phase", "", Role::method},
                           {"time_step", "s", Role::method},
                           {"steady_from", "s", Role::own},
                           {"steady_to", "s", Role::own},
                           {"limit_cycle_reached", "", Role::own}};

/** Six digits; all digits if @p other would read the same. */
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
  const auto found = run.find(condition.name);
  if (found == run.end())
    return "none";
  if (condition.is_word())
    return "'" + std::get<std::string>(found->second) + "'";
  const std::string unit = condition.unit;
  return number_text(std::get<double>(found->second), number_of(other, condition.name)) +
         (unit == "-" ? "" : " " + unit);
}

bool differ(const std::string &name, const RunConditions &a, const RunConditions &b)
{
  const auto one = a.find(name), two = b.find(name);
  const bool in_one = one != a.end(), in_two = two != b.end();
  // A constant coefficient may be compared with coefficients per phase
  // (coefficient_from): homogenized friction yields a constant.
  if (name == "friction_coefficient" && !(in_one && in_two))
    return false;
  return in_one != in_two || (in_one && one->second != two->second);
}
} // namespace

std::optional<double> number_of(const RunConditions &conditions, const std::string &name)
{
  const auto found = conditions.find(name);
  return found == conditions.end()
           ? std::nullopt
           : std::optional<double>(std::get<double>(found->second));
}

RunConditions conditions_below(RunConditions conditions)
{
  conditions["contact_side"] = "upper";
  return conditions;
}

bool is_below(const RunConditions &conditions)
{
  return conditions.count("contact_side") > 0;
}

void write_run_conditions(Hdf5File &file, const RunConditions &conditions)
{
  std::size_t written = 0;
  file.create_group("/run");
  for (const Condition &condition : known)
    if (const auto found = conditions.find(condition.name); found != conditions.end())
      {
        std::visit(
          [&](const auto &value) { file.write_attribute("/run", found->first, value); },
          found->second);
        ++written;
      }
  AssertDimension(written, conditions.size());
  static_cast<void>(written);
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
      conditions[condition.name] =
        file.read_attribute<std::string>("/run", condition.name);
    else
      conditions[condition.name] = file.read_attribute<double>("/run", condition.name);
  return conditions;
}

std::vector<ConditionDifference> condition_differences(const RunConditions &first,
                                                       const RunConditions &second)
{
  std::vector<ConditionDifference> differences;
  for (const Condition &condition : known)
    if (condition.role != Role::own && differ(condition.name, first, second))
      differences.push_back({condition.name, value_text(condition, first, second),
                             value_text(condition, second, first),
                             condition.role == Role::load});
  return differences;
}

std::string differences_text(const std::vector<ConditionDifference> &differences,
                             const bool of_load)
{
  std::string text;
  for (const ConditionDifference &d : differences)
    if (d.of_load == of_load)
      text += (text.empty() ? "" : ", ") + d.name + " is " + d.first + " and " + d.second;
  return text;
}
} // namespace mesoslip
