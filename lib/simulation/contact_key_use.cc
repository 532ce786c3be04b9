#include "io/key_use.h"
#include "simulation/contact_parameters.h"

namespace mesoslip
{
namespace
{
void check_analysis(const KeyUse &use)
{
  const std::string analysis = "Analysis";
  use.only_with(analysis, {"transient"},
                {"Body/Initial velocity", "Time/", "Flat/Ramp", "Flat/Ramp time",
                 "Flat/Expression", "Top/Ramp", "Top/Ramp time", "Top/Expression",
                 "Friction/Law", "Friction/Regularization time", "Friction/Length",
                 "Friction/Reference velocity", "Observation/", "Snapshots/",
                 "Checkpoints/", "Performance/Wavefront", "Performance/Instruction set"});
  use.only_with(analysis, {"transient", "modal"}, {"Top/Platen mass", "Top/Hold from"});
  use.only_with(analysis, {"transient", "static contact"},
                {"Body/Acceleration", "Flat/", "Top/Pressure", "Friction/"});
  use.only_with(analysis, {"transient", "modal", "static contact"},
                {"Body/Material", "Body/Stiffness from", "Body/Stiffness", "Body/Density",
                 "Body/Size", "Body/Cells", "Top/", "Sides/"});
  use.only_with(analysis, {"modal", "static contact"}, {"Performance/Static solver"});
  use.only_with(analysis, {"modal"}, {"Modal/"});
  use.only_with(analysis, {"static contact"}, {"Static contact/"});
  use.only_with(analysis, {"friction homogenization"}, {"Friction homogenization/"});
}

void check_body(const KeyUse &use)
{
  const bool typed_in = use.value("Body/RVE file").empty();
  use.only_if(typed_in, {"Body/Stiffness", "Body/Density"},
              "the materials are those of Body/RVE file", "leave Body/RVE file empty");
  use.only_if(!typed_in, {"Body/Stiffness from"}, "Body/RVE file is empty",
              "name an rve.h5 there");
  use.only_with("Body/Material", {"homogeneous"}, {"Body/Stiffness from"});
}

// The pressure of a held top only scales what the judgement of the limit cycle neglects.
void check_loads(const KeyUse &use)
{
  for (const std::string section : {"Flat/", "Top/"})
    {
      const std::string ramp = section + "Ramp", time = section + "Ramp time",
                        expression = section + "Expression";
      use.only_if(use.value(expression).empty(), {ramp, time},
                  expression + " gives the load at all times",
                  "leave " + expression + " empty");
      use.only_with(ramp, {"linear", "smooth"}, {time});
    }
  use.only_with("Top/Kind", {"pressure"}, {"Top/Lateral held"});
  use.only_with("Top/Kind", {"platen"}, {"Top/Platen mass"});
  use.only_with("Top/Kind", {"pressure", "platen"},
                {"Top/Ramp", "Top/Ramp time", "Top/Expression", "Top/Hold from"});
}

void check_friction(const KeyUse &use)
{
  use.only_with("Friction/Law", {"constant time"}, {"Friction/Regularization time"});
  use.only_with("Friction/Law", {"slip rate"},
                {"Friction/Length", "Friction/Reference velocity"});
  use.only_with("Friction/Coefficient from", {"constant"}, {"Friction/Coefficient"});
  use.only_with("Friction/Coefficient from", {"phases"}, {"Friction/Node rule"});
}

// Probes and snapshots may be switched off on purpose in a file that is otherwise
// complete; then the other keys stay.
void check_observation(const KeyUse &use)
{
  use.only_if(!use.value("Observation/Probes").empty() ||
                use.is_typed("Observation/Probes"),
              {"Observation/Probe interval"}, "there are no probes",
              "name some in Observation/Probes");
  use.only_if(use.is_typed("Snapshots/Interval"), {"Snapshots/From", "Snapshots/To"},
              "Snapshots/Interval is 0 and there are no snapshots",
              "set Snapshots/Interval");
}
} // namespace

void ContactParameters::check_keys(const KeyUse &use)
{
  check_analysis(use);
  check_body(use);
  use.only_with("Time/Time step", {"auto"}, {"Time/Safety factor"});
  check_loads(use);
  check_friction(use);
  check_observation(use);
}
} // namespace mesoslip
