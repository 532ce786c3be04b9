#include "sliding/stated_conditions.h"

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
  conditions.words[name + "_history"] = load.shape();
  if (!load.is_expression())
    conditions.numbers[name] = load.amplitude();
  if (load.duration() > 0.)
    conditions.numbers[name + "_ramp_time"] = load.duration();
}

void add_top(RunConditions &conditions, const TopSetup &top)
{
  using Kind              = TopSetup::Kind;
  conditions.words["top"] = top.kind == Kind::pressure ? "pressure"
                            : top.kind == Kind::platen ? "platen"
                                                       : "held";
  conditions.words["lateral_held"] =
    yes_or_no(top.kind != Kind::pressure || top.lateral_held);
  if (top.kind == Kind::platen)
    conditions.numbers["platen_mass"] = top.platen_mass;
  if (std::isfinite(top.hold_from))
    conditions.numbers["hold_from"] = top.hold_from;
}

void add_friction(RunConditions &conditions, const FrictionParameters &friction)
{
  conditions.numbers["gap"] = friction.gap;
  conditions.words["coefficient_from"] =
    friction.coefficient_by_phase ? "phases" : "constant";
  if (friction.coefficient_by_phase)
    conditions.words["node_rule"] = friction.node_rule;
  else
    conditions.numbers["friction_coefficient"] = friction.coefficient;
  conditions.words["friction_law"] = friction.law_name;
  if (friction.law_name == "slip rate")
    {
      conditions.numbers["slip_length"]        = friction.slip_length;
      conditions.numbers["reference_velocity"] = friction.reference_velocity;
    }
  else
    conditions.numbers["regularization_time"] = friction.law.time;
}
} // namespace

RunConditions stated_conditions(const ContactParameters &parameters)
{
  RunConditions conditions;
  const BodyParameters &body   = parameters.body;
  const bool transient         = parameters.analysis == ContactAnalysis::transient;
  conditions.words["analysis"] = transient ? "transient" : "static contact";
  conditions.words["material"] = body.heterogeneous ? "heterogeneous" : "homogeneous";
  add_load(conditions, "pressure", parameters.top.pressure);
  add_load(conditions, "velocity", parameters.friction.flat_velocity);
  add_top(conditions, parameters.top);
  add_friction(conditions, parameters.friction);
  conditions.words["left_side"]  = side_text(parameters.sides.left_held);
  conditions.words["right_side"] = side_text(parameters.sides.right_held);
  conditions.words["periodic"]   = yes_or_no(parameters.periodic);
  const std::string axes[]       = {"x", "y"};
  for (unsigned int d = 0; d < 2; ++d)
    {
      conditions.numbers["acceleration_" + axes[d]] = body.acceleration[d];
      if (transient)
        conditions.numbers["initial_velocity_" + axes[d]] = body.initial_velocity[d];
    }
  if (transient)
    {
      conditions.numbers["beta2"]         = parameters.time.beta2;
      conditions.numbers["rayleigh_beta"] = parameters.time.beta;
    }
  return conditions;
}
} // namespace mesoslip
