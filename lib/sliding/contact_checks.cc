#include "base/errors.h"
#include "parameters/keys.h"
#include "sliding/contact_parameters.h"

namespace mesoslip
{
namespace
{
void check_analysis(const Keys &keys)
{
  const std::string analysis = "Analysis";
  keys.only_with(analysis, {"transient"},
                 {"Body/Initial velocity", "Time/", "Flat/Ramp", "Flat/Ramp time",
                  "Flat/Expression", "Top/Ramp", "Top/Ramp time", "Top/Expression",
                  "Friction/Law", "Friction/Regularization time", "Friction/Length",
                  "Friction/Reference velocity", "Observation/", "Snapshots/",
                  "Checkpoints/", "Performance/Wavefront",
                  "Performance/Instruction set"});
  keys.only_with(analysis, {"transient", "modal"}, {"Top/Platen mass", "Top/Hold from"});
  keys.only_with(analysis, {"transient", "static contact"},
                 {"Body/Acceleration", "Flat/", "Top/Pressure", "Friction/"});
  keys.only_with(analysis, {"transient", "modal", "static contact"},
                 {"Body/Material", "Body/Stiffness from", "Body/Stiffness",
                  "Body/Density", "Body/Size", "Body/Cells", "Top/", "Sides/"});
  keys.only_with(analysis, {"modal", "static contact"}, {"Performance/Static solver"});
  keys.only_with(analysis, {"modal"}, {"Modal/"});
  keys.only_with(analysis, {"static contact"}, {"Static contact/"});
  keys.only_with(analysis, {"friction homogenization"}, {"Friction homogenization/"});
}

void check_body(const Keys &keys)
{
  const bool typed_in = keys.value("Body/RVE file").empty();
  keys.only_if(typed_in, {"Body/Stiffness", "Body/Density"},
               "the materials are those of Body/RVE file", "leave Body/RVE file empty");
  keys.only_if(!typed_in, {"Body/Stiffness from"}, "Body/RVE file is empty",
               "name an rve.h5 there");
  keys.only_with("Body/Material", {"homogeneous"}, {"Body/Stiffness from"});
}

// The pressure of a held top only scales what the judgement of the limit cycle neglects.
void check_loads(const Keys &keys)
{
  for (const std::string section : {"Flat/", "Top/"})
    {
      const std::string ramp = section + "Ramp", time = section + "Ramp time",
                        expression = section + "Expression";
      keys.only_if(keys.value(expression).empty(), {ramp, time},
                   expression + " gives the load at all times",
                   "leave " + expression + " empty");
      keys.only_with(ramp, {"linear", "smooth"}, {time});
    }
  keys.only_with("Top/Kind", {"pressure"}, {"Top/Lateral held"});
  keys.only_with("Top/Kind", {"platen"}, {"Top/Platen mass"});
  keys.only_with("Top/Kind", {"pressure", "platen"},
                 {"Top/Ramp", "Top/Ramp time", "Top/Expression", "Top/Hold from"});
}

void check_friction(const Keys &keys)
{
  keys.only_with("Friction/Law", {"constant time"}, {"Friction/Regularization time"});
  keys.only_with("Friction/Law", {"slip rate"},
                 {"Friction/Length", "Friction/Reference velocity"});
  keys.only_with("Friction/Coefficient from", {"constant"}, {"Friction/Coefficient"});
  keys.only_with("Friction/Coefficient from", {"phases"}, {"Friction/Node rule"});
}

// Probes and snapshots may be switched off on purpose in a file that is otherwise
// complete; then the other keys stay.
void check_observation(const Keys &keys)
{
  keys.only_if(!keys.value("Observation/Probes").empty() ||
                 keys.is_typed("Observation/Probes"),
               {"Observation/Probe interval"}, "there are no probes",
               "name some in Observation/Probes");
  keys.only_if(keys.is_typed("Snapshots/Interval"), {"Snapshots/From", "Snapshots/To"},
               "Snapshots/Interval is 0 and there are no snapshots",
               "set Snapshots/Interval");
}
} // namespace

void ContactParameters::check_keys(const Keys &keys)
{
  check_analysis(keys);
  check_body(keys);
  keys.only_with("Time/Time step", {"auto"}, {"Time/Safety factor"});
  check_loads(keys);
  check_friction(keys);
  check_observation(keys);
}

void ContactParameters::check() const
{
  if (body.stiffness.size() == 5)
    throw UserError(
      "Body/Stiffness: 5 numbers found; give D11, D12, D22, D33 or all six");
  if (body.heterogeneous && body.rve_file.empty())
    throw UserError(
      "Body/RVE file is empty, but a heterogeneous body takes its phases and "
      "morphology from there; run rve_homogenization and name its rve.h5");
  if (!body.rve_file.empty())
    require_readable_file("Body/RVE file: ", body.rve_file,
                          "run rve_homogenization first");
  if (step.dt > time.end_time)
    throw UserError("Time/Time step: " + to_text(step.dt) +
                    " s is longer than End time, " + to_text(time.end_time) + " s");
  const std::array<bool, 2> &left = sides.left_held, &right = sides.right_held;
  if (periodic && (left[0] || left[1] || right[0] || right[1]))
    throw UserError("Sides/Periodic is true, so Left and Right have to be free");
  if (top.kind == TopSetup::Kind::platen && (left[1] || right[1]))
    throw UserError(
      "Sides: u_y is held on a side, but the platen of Top/Kind moves its corner; hold "
      "u_x only, or set Top/Kind = pressure or held");
}
} // namespace mesoslip
