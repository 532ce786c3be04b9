#include "sliding/plausible_input.h"

#include "dynamics/critical_time_step.h"
#include "material/plausibility.h"
#include "sliding/transient/run_plan.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
using Ranges = std::vector<PlausibleRange>;

// Strains: below the smallest a pressure is a slip, above the largest a solid yields.
constexpr double smallest_strain = 1e-9, largest_strain = 1e-2;
// Of the wave speed: 250 m/s in the paper's pin.
constexpr double fastest = 0.05;
// Crossings of the body by a wave: 3 ms in a pin of 16 mm are a thousand.
constexpr double most_crossings = 1e5;
constexpr double atom           = 1e-10; // m

std::string percent(const double share)
{
  return quantity_text(100. * share, "%");
}

std::string run_text(const ContactParameters &parameters)
{
  return "the whole run (" + quantity_text(parameters.time.end_time, "s") + ")";
}

PlausibleRange at_most(const std::string &key,
                       const double value,
                       const std::string &unit,
                       const double highest,
                       const std::string &if_high)
{
  PlausibleRange range{key, value, unit};
  range.highest = highest;
  range.if_high = if_high;
  return range;
}

/** A duration that has to act within the run. */
PlausibleRange within_run(const std::string &key,
                          const double value,
                          const double longest,
                          const ContactParameters &parameters,
                          const std::string &consequence)
{
  return at_most(key, value, "s", longest,
                 "longer than " + run_text(parameters) + ", so that " + consequence +
                   "; is it in s?");
}

std::string load_name(const LoadHistory &load,
                      const std::string &section,
                      const std::string &key,
                      const std::string &which)
{
  return load.is_expression() ? "the " + which + " value of " + section + "/Expression"
                              : section + "/" + key;
}

/** That a ramp is over before the run is. */
void add_ramp(Ranges &ranges,
              const LoadHistory &load,
              const std::string &section,
              const ContactParameters &parameters)
{
  if (load.is_expression() || load.amplitude() == 0.)
    return;
  PlausibleRange range{"The share of its load that section " + section +
                         " reaches in the run",
                       load(parameters.time.end_time) / load.amplitude(), ""};
  range.lowest = 0.5;
  range.if_low = "as " + section + "/Ramp time is longer than " + run_text(parameters) +
                 "; is it in s?";
  ranges.push_back(range);
}

void add_pressure(Ranges &ranges,
                  const LoadRange &pressure,
                  const std::string &name,
                  const double stiffness)
{
  PlausibleRange range{name, pressure.largest_size(), "Pa"};
  if (range.value > 0.)
    range.lowest = smallest_strain * stiffness;
  range.if_low = "which strains the body by " +
                 quantity_text(range.value / stiffness, "") +
                 " only; is it in MPa? Pressures are in Pa";
  range.highest = largest_strain * stiffness;
  range.if_high = "which strains the body by " + percent(range.value / stiffness) +
                  ", beyond small strains; is it in Pa?";
  ranges.push_back(range);
}

void add_top(Ranges &ranges,
             const ContactParameters &parameters,
             const UniformMaterial &material)
{
  const TopSetup &top = parameters.top;
  if (top.kind == TopSetup::Kind::held || !(top.hold_from > 0.))
    return;
  const LoadRange pressure = load_range(top.pressure, parameters.time.end_time);
  add_pressure(ranges, pressure, load_name(top.pressure, "Top", "Pressure", "largest"),
               BodyScales(material).stiffness);
  add_ramp(ranges, top.pressure, "Top", parameters);
  PlausibleRange pull{load_name(top.pressure, "Top", "Pressure", "smallest"),
                      pressure.smallest, "Pa"};
  pull.lowest = 0.;
  pull.if_low = "which pulls the body off the flat; a positive pressure presses it on";
  ranges.push_back(pull);
  if (std::isfinite(top.hold_from))
    ranges.push_back(within_run("Top/Hold from", top.hold_from, parameters.time.end_time,
                                parameters, "the top is never held"));
  const double mass = material.total_mass();
  ranges.push_back(at_most("Top/Platen mass", top.platen_mass, "kg/m", 1e4 * mass,
                           "more than 10000 times the body's " +
                             quantity_text(mass, "kg/m") +
                             "; is it in kg per m of thickness?"));
}

/** Against the speed of waves. */
PlausibleRange
plausible_speed(const std::string &key, const double speed, const double wave_speed)
{
  return at_most(key, speed, "m/s", fastest * wave_speed,
                 percent(speed / wave_speed) + " of the speed of waves in the body, " +
                   quantity_text(wave_speed, "m/s") +
                   "; is it in mm/s? Velocities are in m/s");
}

void add_velocities(Ranges &ranges,
                    const ContactParameters &parameters,
                    const UniformMaterial &material)
{
  const double end = parameters.time.end_time, c = BodyScales(material).wave_speed;
  const LoadHistory &flat = parameters.friction.flat_velocity;
  const double speed      = load_range(flat, end).largest_size();
  PlausibleRange range =
    plausible_speed(load_name(flat, "Flat", "Velocity", "largest"), speed, c);
  if (speed > 0.)
    range.lowest = atom / end;
  range.if_low = "with which the flat moves less than the width of an atom in " +
                 run_text(parameters) + "; is it in m/s?";
  ranges.push_back(range);
  add_ramp(ranges, flat, "Flat", parameters);
  for (unsigned int d = 0; d < 2; ++d)
    ranges.push_back(
      plausible_speed("Body/Initial velocity along " + std::string(1, "xy"[d]),
                      std::fabs(parameters.body.initial_velocity[d]), c));
}

/** How far the body can come towards the flat in the run, when nothing stops it. */
double reach(const ContactParameters &parameters, const UniformMaterial &material)
{
  const double end      = parameters.time.end_time;
  const double pressure = parameters.top.kind == TopSetup::Kind::held
                            ? 0.
                            : load_range(parameters.top.pressure, end).largest_size();
  const double acceleration =
    std::fabs(parameters.body.acceleration[1]) +
    pressure * material.grid().extent(0) / material.total_mass();
  return std::fabs(parameters.body.initial_velocity[1]) * end +
         0.5 * acceleration * end * end;
}

void add_contact(Ranges &ranges,
                 const ContactParameters &parameters,
                 const UniformMaterial &material)
{
  const FrictionParameters &friction = parameters.friction;
  const double end                   = parameters.time.end_time;
  // In a short run the first vibrations count, of about ten crossings.
  const double longest = std::max(end, 10. * crossing_time(material));
  if (friction.slip_length > 0.)
    {
      const double speed = load_range(friction.flat_velocity, end).largest_size();
      ranges.push_back(
        within_run("L / (|V| + V_ref), of Friction/Length and Reference velocity at the "
                   "speed of the "
                   "flat,",
                   friction.slip_length / (speed + friction.reference_velocity), longest,
                   parameters, "friction hardly comes to act"));
    }
  else
    ranges.push_back(within_run("Friction/Regularization time", friction.law.time,
                                longest, parameters, "friction hardly comes to act"));
  const double furthest = reach(parameters, material);
  ranges.push_back(
    at_most("Flat/Gap", friction.gap, "m", furthest,
            "but pressure, initial velocity and acceleration move the body by " +
              quantity_text(furthest, "m") +
              " at most before Time/End time: it never touches the flat; is it in m?"));
}

void add_times(Ranges &ranges,
               const ContactParameters &parameters,
               const UniformMaterial &material)
{
  const TimeParameters &time = parameters.time;
  const double crossing      = crossing_time(material);
  ranges.push_back(at_most("Time/End time", time.end_time, "s", most_crossings * crossing,
                           "in which a wave crosses the body " +
                             quantity_text(time.end_time / crossing, "times") +
                             "; is it in s?"));
  if (std::isnan(time.time_step))
    return;
  const double critical =
    critical_time_step(element_frequency_bound(material), time.beta2, time.beta);
  PlausibleRange step{"Time/Time step", time.time_step, "s"};
  step.lowest = 1e-3 * critical;
  step.if_low = "less than a thousandth of the critical " + quantity_text(critical, "s") +
                "; is it in s?";
  ranges.push_back(step);
}

void add_observation(Ranges &ranges,
                     const ContactParameters &parameters,
                     const double n_steps)
{
  const ObservationParameters &o = parameters.observation;
  const auto interval            = [&](const std::string &key, const unsigned int steps) {
    // 200 is the default where nothing is asked for.
    ranges.push_back(at_most(
                 "Observation/" + key, double(steps), "steps", std::max(200., n_steps),
                 "more than " + run_text(parameters) + " has, " + quantity_text(n_steps, "steps")));
  };
  interval("History interval", o.history_interval);
  interval("Energy interval", o.energy_interval);
  if (!o.probes.empty())
    interval("Probe interval", o.probe_interval);
  if (!(o.snapshots_interval > 0.))
    return;
  const double end = parameters.time.end_time;
  ranges.push_back(within_run("Snapshots/Interval", o.snapshots_interval, end, parameters,
                              "there is one snapshot only"));
  if (!std::isnan(o.snapshots_to))
    ranges.push_back(
      at_most("Snapshots/To", o.snapshots_to, "s", 2. * end,
              "long after the end of " + run_text(parameters) + "; is it in s?"));
}

/** What is no range: values that are not finite, and a body that nothing moves. */
void add_others(std::vector<std::string> &sentences, const ContactParameters &parameters)
{
  const double end = parameters.time.end_time;
  for (const auto &[load, key] :
       {std::make_pair(&parameters.top.pressure, "Top/Expression"),
        std::make_pair(&parameters.friction.flat_velocity, "Flat/Expression")})
    if (!load_range(*load, end).finite)
      sentences.push_back(std::string(key) + " is not finite at all times of " +
                          run_text(parameters) + ", which will stop it");
  const BodyParameters &body = parameters.body;
  if (parameters.top.kind != TopSetup::Kind::held &&
      load_range(parameters.top.pressure, end).largest_size() == 0. &&
      body.initial_velocity == std::array<double, 2>{} &&
      body.acceleration == std::array<double, 2>{})
    sentences.push_back("Top/Pressure is 0 in " + run_text(parameters) +
                        " and Body/Initial velocity and Acceleration are 0: nothing "
                        "presses the body on the flat");
}
bool flat_moves(const ContactParameters &parameters)
{
  constexpr unsigned int looks = 100;
  for (unsigned int k = 0; k <= looks; ++k)
    if (parameters.friction.flat_velocity(parameters.time.end_time * k / looks) != 0.)
      return true;
  return false;
}

bool slides_undamped(const ContactParameters &parameters)
{
  const FrictionParameters &friction = parameters.friction;
  return friction.law.time == 0. && !friction.law.node_law &&
         parameters.time.beta == 0. && parameters.time.beta2 == 0.5 &&
         (friction.coefficient_by_phase || friction.coefficient > 0.) &&
         flat_moves(parameters);
}
} // namespace

std::vector<std::string> implausible_static_load(const ContactParameters &parameters,
                                                 const UniformMaterial &material)
{
  Ranges ranges;
  const double pressure = parameters.top.pressure.amplitude();
  LoadRange range;
  range.smallest = range.largest = pressure;
  add_pressure(ranges, range, "Top/Pressure", BodyScales(material).stiffness);
  return implausible(ranges);
}

std::string crossing_text(const ContactParameters &parameters,
                          const UniformMaterial &material)
{
  std::ostringstream text;
  text.precision(4);
  text << "a wave takes " << 1e3 * crossing_time(material)
       << " ms from the flat to the top, the run " << 1e3 * parameters.time.end_time
       << " ms";
  return text.str();
}

std::vector<std::string> implausible_run(const ContactParameters &parameters,
                                         const UniformMaterial &material)
{
  Ranges ranges;
  add_times(ranges, parameters, material);
  add_top(ranges, parameters, material);
  add_velocities(ranges, parameters, material);
  add_contact(ranges, parameters, material);
  add_observation(ranges, parameters, largest_number_of_steps(parameters, material));
  std::vector<std::string> sentences = implausible(ranges);
  add_others(sentences, parameters);
  if (!(parameters.time.end_time >= 2. * crossing_time(material)))
    sentences.push_back(
      crossing_text(parameters, material) +
      ": it ends before the wave is back; are Body/Size and Time/End time in "
      "m and s, and the stiffness in Pa?");
  const std::string damping =
    damping_warning(parameters, material, "the critical time step");
  if (!damping.empty())
    sentences.push_back(damping);
  if (slides_undamped(parameters))
    sentences.emplace_back(
      "the run has neither regularization (Friction/Law = coulomb or Regularization time "
      "= 0) nor damping (Time/Rayleigh beta = 0): while nodes slide, waves of three to "
      "four cells grow that the body does not have, the faster the finer the grid is, so "
      "that no grid is fine enough; set one of them, the paper has 1.5e-6 and 4.4e-9 s");
  return sentences;
}
} // namespace mesoslip
