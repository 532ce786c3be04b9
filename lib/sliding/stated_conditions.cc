#include "sliding/contact_parameters.h"

#include <cmath>

namespace mesoslip
{
namespace
{
std::string yes_or_no(const bool value)
{
  return value ? "yes" : "no";
}

/** "free", "u_x", "u_y" or "both", as in the parameters. */
std::string side_text(const std::array<bool, 2> &held)
{
  if (held[0] && held[1])
    return "both";
  return held[0] ? "u_x" : held[1] ? "u_y" : "free";
}

void add_load(RunConditions &conditions, const std::string &name, const LoadHistory &load)
{
  conditions[name + "_history"] = load.shape();
  if (!load.is_expression())
    conditions[name] = load.amplitude();
  if (load.duration() > 0.)
    conditions[name + "_ramp_time"] = load.duration();
}

void add_friction(RunConditions &conditions, const ContactParameters &parameters)
{
  const FrictionParameters &friction = parameters.friction;
  conditions["gap"]                  = parameters.contact.gap;
  conditions["coefficient_from"] = friction.coefficient_by_phase ? "phases" : "constant";
  if (friction.coefficient_by_phase)
    conditions["node_rule"] = friction.node_rule;
  else
    conditions["friction_coefficient"] = friction.coefficient;
  conditions["friction_law"] = friction.law_name;
  if (friction.law_name == "slip rate")
    {
      conditions["slip_length"]        = friction.slip_length;
      conditions["reference_velocity"] = friction.reference_velocity;
    }
  else
    conditions["regularization_time"] = parameters.contact.law.time;
}
} // namespace

RunConditions ContactParameters::stated_conditions() const
{
  using Kind               = TopSetup::Kind;
  const bool transient     = analysis == ContactAnalysis::transient;
  RunConditions conditions = {
    {"analysis", transient ? "transient" : "static contact"},
    {"material", body.heterogeneous ? "heterogeneous" : "homogeneous"},
    {"top", top.kind == Kind::pressure ? "pressure"
            : top.kind == Kind::platen ? "platen"
                                       : "held"},
    {"lateral_held", yes_or_no(top.kind != Kind::pressure || top.lateral_held)},
    {"left_side", side_text(sides.left_held)},
    {"right_side", side_text(sides.right_held)},
    {"periodic", yes_or_no(periodic)},
    {"acceleration_x", step.acceleration[0]},
    {"acceleration_y", step.acceleration[1]}};
  add_load(conditions, "pressure", top.pressure);
  add_load(conditions, "velocity", contact.flat_velocity);
  add_friction(conditions, *this);
  if (top.kind == Kind::platen)
    conditions["platen_mass"] = top.platen_mass;
  if (std::isfinite(top.hold_from))
    conditions["hold_from"] = top.hold_from;
  if (transient)
    {
      conditions["initial_velocity_x"] = body.initial_velocity[0];
      conditions["initial_velocity_y"] = body.initial_velocity[1];
      conditions["beta2"]              = step.beta2;
      conditions["rayleigh_beta"]      = step.beta;
    }
  return conditions;
}
} // namespace mesoslip
