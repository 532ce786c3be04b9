#include "sliding/complex/complex_parameters.h"

#include "base/errors.h"
#include "eigenvalues/complex/sliding_pencil.h"
#include "parameters/keys.h"
#include "sliding/analyses/modal_cases.h"
#include "sliding/complex/steady_friction.h"
#include "sliding/contact_parameters.h"

#include <cmath>

namespace mesoslip
{
void ComplexModesParameters::bind(Keys &keys)
{
  const auto section = keys.section("Complex modes");
  keys.bind_or_auto(
    "Highest frequency", highest_frequency, Range::positive(),
    "All modes up to this frequency are found; auto: that of a longitudinal "
    "wave as long as the body is high [Hz]");
  keys.bind("Lowest frequency", lowest_frequency, Range::non_negative(),
            "Modes below this frequency are neither looked for nor counted. Above 0 it "
            "keeps the search away from what only relaxes, which takes many solves if "
            "friction relaxes slowly, about from 0.3 ms on [Hz]");
  keys.require(!(lowest_frequency >= highest_frequency), "Lowest frequency",
               to_text(lowest_frequency) + " Hz is not below Highest frequency, " +
                 to_text(highest_frequency) + " Hz");
  double decay = 0. - least_growth;
  keys.bind(
    "Fastest decay", decay, Range::non_negative(),
    "Modes that decay at this rate at most are listed, too, if they vibrate faster "
    "than they decay; 0: only modes that grow [1/s]");
  least_growth = -decay;
  keys.bind("Tolerance", tolerance, Range::open(0., 1e-3),
            "Relative accuracy of the eigenvalues in the Arnoldi iteration [-]");
  keys.bind(
    "Count modes", count,
    "Count the eigenvalues by the argument principle and so check that no mode is "
    "missing; false is faster");
  keys.bind("Number of shapes", n_shapes, 0, 10000,
            "Number of modes, from the fastest growing on, whose shapes are written [-]");
  keys.bind(
    "Sweep", sweep,
    {"none", "friction coefficient", "regularization time", "velocity", "pressure",
     "normal stiffness"},
    "Parameter that takes the Sweep values one after the other, besides the value "
    "that it has elsewhere");
  keys.bind_list(
    "Sweep values", values, Range::any(),
    "Values of what Sweep names, in its unit: Friction/Coefficient [-], with "
    "Coefficient from = phases a factor of the coefficients of all phases [-]; "
    "Friction/Regularization time [s], Flat/Velocity [m/s], Supports/Top/Pressure [Pa] "
    "or "
    "Flat/Normal stiffness [Pa/m]; curves of modes are followed in this order",
    0, 10000);
  keys.require(sweep == ModeSweep::none || !values.empty(), "Sweep values",
               "it is empty; list the values that Sweep is to take");
  keys.only_if(sweep != ModeSweep::none, {"Sweep values"}, "Complex modes/Sweep is none",
               "name a parameter there");
  for (const double value : values)
    keys.require(sweep == ModeSweep::velocity ? value != 0.
                 : sweep == ModeSweep::pressure || sweep == ModeSweep::normal_stiffness
                   ? value > 0.
                   : value >= 0.,
                 "Sweep values",
                 "one of them is " + to_text(value) +
                   (sweep == ModeSweep::velocity   ? "; without velocity nothing slides"
                    : sweep == ModeSweep::pressure ? "; without pressure nothing touches"
                    : sweep == ModeSweep::normal_stiffness
                      ? "; springs are stiffer than 0"
                      : "; they must not be negative"));
}

ContactParameters with_swept(ContactParameters p, const double value)
{
  switch (p.complex_modes.sweep)
    {
    case ModeSweep::coefficient:
      p.friction.coefficient = value;
      break;
    case ModeSweep::regularization_time:
      p.contact.law.time = value;
      break;
    case ModeSweep::velocity:
      p.contact.flat_velocity = LoadHistory(value);
      break;
    case ModeSweep::pressure:
      p.top.pressure = LoadHistory(value);
      break;
    case ModeSweep::normal_stiffness:
      p.contact.normal_spring.stiffness = value;
      break;
    default:
      break;
    }
  return p;
}

SlidingLaw sliding_law(const ContactParameters &p)
{
  const FrictionParameters &friction = p.friction;
  SlidingLaw law;
  law.alpha = p.step.common_alpha();
  law.beta  = p.step.least_beta();
  if (friction.law_name == "slip rate")
    law.delta = friction.slip_length / (std::fabs(p.contact.flat_velocity.amplitude()) +
                                        friction.reference_velocity);
  else
    law.delta = p.contact.law.time;
  return law;
}

void check_complex_modes(const ContactParameters &p)
{
  const std::string &law = p.friction.law_name;
  const ModeSweep sweep  = p.complex_modes.sweep;
  if (law != "coulomb" && law != "constant time" && law != "slip rate")
    throw UserError("Friction/Law is " + law +
                    ", about which complex modes are not linearized; use coulomb, "
                    "constant time or slip rate");
  if (p.contact.flat_velocity.amplitude() == 0.)
    throw UserError(
      "Flat/Velocity is 0; complex modes are those of steady sliding, set it "
      "to the velocity of the flat");
  if (p.contact.law.normal_stress.is_given())
    throw UserError("Friction/Normal stress is " + p.friction.normal_stress +
                    ", a memory which changes the vibrations of steady sliding and is "
                    "not among what complex modes linearize; use a transient run, or set "
                    "it to instant for the modes without the memory");
  if (p.contact.law.coefficient_law)
    {
      SlipPoint at;
      at.slip_rate = std::fabs(p.contact.flat_velocity.amplitude());
      at.pressure  = std::fabs(p.top.pressure.amplitude());
      steady_friction(*p.contact.law.coefficient_law, at);
      if (sweep == ModeSweep::coefficient)
        throw UserError("Complex modes/Sweep is friction coefficient, but there is a "
                        "Friction/Coefficient law, whose coefficient is not that key; "
                        "sweep the velocity, or set the law to constant");
      if (top_at_start(p).is_held())
        throw UserError(
          "Friction/Coefficient law is not constant, but the top is held and "
          "nothing presses the body on the flat, which slopes of the "
          "coefficient are multiplied with; set Supports/Top/Kind = platen or pressure");
    }
  if (sweep == ModeSweep::pressure && top_at_start(p).is_held())
    throw UserError(
      "Complex modes/Sweep is pressure, but the top is held; set Supports/Top/Kind = "
      "platen or pressure");
  if (sweep == ModeSweep::normal_stiffness && !p.contact.is_compliant())
    throw UserError(
      "Complex modes/Sweep is normal stiffness, but Flat/Normal stiffness is "
      "auto, a rigid flat; give a stiffness there as well");
  if (sweep == ModeSweep::regularization_time && law != "constant time")
    throw UserError("Complex modes/Sweep is regularization time, but Friction/Law is " +
                    law + "; set it to constant time");
}
} // namespace mesoslip
