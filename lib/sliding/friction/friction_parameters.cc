#include "sliding/friction/friction_parameters.h"

#include "base/errors.h"
#include "base/text.h"
#include "parameters/keys.h"
#include "sliding/contact_parameters.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
void bind_normal_stress(Keys &keys, std::string &kind, NormalStressMemory &memory)
{
  double time = 1e-6, length = 1e-6, reference_velocity = 1e-3;
  keys.bind(
    "Normal stress", kind, {"instant", "constant time", "slip rate"},
    "What the limit of friction follows: the normal stress sigma at once, mu sigma; "
    "or mu sigma* with d sigma*/dt = -(sigma* - sigma)/t_pc (Prakash and Clifton), "
    "t_pc being constant or L/(|V_rel| + V_ref)");
  keys.bind("Normal stress time", time, Range::positive(),
            "t_pc of Normal stress = constant time [s]");
  keys.bind("Normal stress length", length, Range::positive(),
            "L of Normal stress = slip rate [m]");
  keys.bind("Normal stress velocity", reference_velocity, Range::positive(),
            "V_ref of Normal stress = slip rate, which keeps t_pc finite at rest [m/s]");
  keys.only_with("Normal stress", {"constant time"}, {"Normal stress time"});
  keys.only_with("Normal stress", {"slip rate"},
                 {"Normal stress length", "Normal stress velocity"});
  memory = kind == "constant time" ? NormalStressMemory{time, 0., 0.}
           : kind == "slip rate"   ? NormalStressMemory{0., length, reference_velocity}
                                   : NormalStressMemory();
}
} // namespace

void FrictionParameters::bind(Keys &keys, FrictionLaw &law)
{
  keys.bind(
    "Law", law_name, {"coulomb", "constant time", "slip rate"},
    "Coulomb's law; the friction relaxing to it in a constant time delta (eq. 7); "
    "or in the time delta = L / (|V_rel| + V_ref), V_rel being the velocity of the "
    "node relative to the flat");
  keys.bind(
    "Coefficient from", coefficient_by_phase, {"constant", "phases"},
    "One friction coefficient for all nodes, or those of the phases in the RVE file "
    "(section 4 of the paper). With a Coefficient law it is that of the law times the "
    "coefficient of the phase over Coefficient, of a table or an expression times the "
    "coefficient of the phase");
  keys.bind("Coefficient", coefficient, Range::non_negative(),
            "Coulomb's friction coefficient mu of all nodes [-]");
  keys.bind("Regularization time", law.time, Range::non_negative(),
            "Relaxation time delta of eq. (7), which damps the waves of the grid that "
            "plain Coulomb friction excites; 0 is plain Coulomb [s]");
  keys.bind("Length", slip_length, Range::positive(),
            "Slip length L of Law = slip rate [m]");
  keys.bind("Reference velocity", reference_velocity, Range::positive(),
            "Velocity V_ref of Law = slip rate, which keeps delta finite at rest [m/s]");
  keys.bind("Node rule", node_rule, {"stiffness", "mean", "largest", "smallest"},
            "Friction coefficient of a node between cells of two phases: their mean "
            "weighted "
            "with the stiffness D22, in proportion to which they share the pressure, the "
            "plain mean, or one of the two");
  coefficient_law.bind(keys);
  bind_normal_stress(keys, normal_stress, law.normal_stress);
  keys.only_with("Law", {"constant time"}, {"Regularization time"});
  keys.only_with("Law", {"slip rate"}, {"Length", "Reference velocity"});
  keys.only_with("Coefficient from", {"phases"}, {"Node rule"});
  if (!coefficient_law.is_given())
    keys.only_with("Coefficient from", {"constant"}, {"Coefficient"});
  keys.only_if(coefficient_law.has_reference(), {"Coefficient"},
               "Coefficient law is a table or an expression, which say it all",
               "choose another law");
  keys.require(
    !coefficient_law.is_given() || !coefficient_law.has_reference() || coefficient > 0.,
    "Coefficient", "it is 0, but Coefficient law refers to it; give it above 0");
  if (law_name == "coulomb")
    law.time = 0.;
  if (law_name == "slip rate")
    law.node_law =
      std::make_shared<SlipRateRegularization>(slip_length, reference_velocity);
}

void FrictionParameters::make_coefficient_law(const Keys &keys,
                                              const Use &use,
                                              FrictionLaw &law)
{
  if (!coefficient_law.is_given() || !keys.are_read())
    return;
  const std::string key = "Friction/Coefficient law";
  const auto require    = [&](const bool holds, const std::string &what) {
    keys.require(holds, key, "it is '" + keys.value(key) + "', " + what);
  };
  const auto made = coefficient_law.make(coefficient, use.dim);
  SlipPoint at;
  at.pressure = use.pressure;
  if (use.in_time)
    {
      at.state = made->steady_state(0.);
      if (!coefficient_law.has_reference())
        coefficient = made->coefficient(at);
      require(
        std::isfinite(coefficient),
        "which at rest and Supports/Top/Pressure has a negative coefficient or none");
      at.slip_rate = use.speed;
      require(std::isfinite(made->coefficient(at)),
              "which at the speed of the flat and Supports/Top/Pressure has a negative "
              "coefficient "
              "or none");
      law.coefficient_law = made;
      law.reference =
        coefficient_by_phase && !coefficient_law.has_reference() ? 1. : coefficient;
      return;
    }
  require(
    !coefficient_by_phase,
    "which statics have for one coefficient of all nodes only; set Coefficient from "
    "= constant");
  require(
    !made->looks_around(),
    "which depends on pressure, time or place; statics know a coefficient at a slip "
    "rate only, use a transient run");
  require(coefficient_law.kind != CoefficientLawParameters::Kind::rate_and_state ||
            use.speed > 0.,
          "which has no coefficient at rest; set Flat/Velocity, whose steady friction is "
          "then taken");
  require(!use.flat_displaced || !made->state(),
          "which depends on the slip; statics do not follow it, use a transient run");
  at.slip_rate = use.speed;
  at.state     = made->steady_state(use.speed);
  coefficient  = made->coefficient(at);
  require(std::isfinite(coefficient),
          "which at the speed of the flat has a negative coefficient or none");
}

std::string FrictionParameters::memory_text(const NormalStressMemory &memory)
{
  if (!memory.is_given())
    return "";
  return memory.length > 0.
           ? "slip rate, L = " + to_text(memory.length) +
               " m, V_ref = " + to_text(memory.reference_velocity) + " m/s"
           : "constant time, t_pc = " + to_text(memory.time) + " s";
}

void ContactParameters::make_coefficient_law(const Keys &keys)
{
  FrictionParameters::Use use;
  use.dim      = mesh.mesh.dim;
  use.pressure = std::fabs(top.pressure.amplitude());
  use.speed    = std::fabs(contact.flat_velocity.amplitude());
  use.in_time  = analysis == ContactAnalysis::transient ||
                analysis == ContactAnalysis::complex_modes; // which linearizes the law
  use.flat_displaced = static_load.moves_flat();
  friction.make_coefficient_law(keys, use, contact.law);
}

void ContactParameters::check_contact_map(const Keys &keys) const
{
  const auto asked = [&](const std::string &name) {
    return map.interval > 0. &&
           std::find(map.fields.begin(), map.fields.end(), name) != map.fields.end();
  };
  const FrictionLaw &law = contact.law;
  keys.require(!asked("law state") ||
                 (law.coefficient_law && law.coefficient_law->state()),
               "Contact map/Fields",
               "it names law state, but the Friction/Coefficient law has none; leave it "
               "out, or choose a slip weakening or rate and state");
  keys.require(!asked("remembered pressure") || law.normal_stress.is_given(),
               "Contact map/Fields",
               "it names remembered pressure, but Friction/Normal stress acts at once; "
               "leave it out, or set Normal stress");
}
} // namespace mesoslip
