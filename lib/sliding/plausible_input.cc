#include "sliding/plausible_input.h"

#include "dynamics/critical_time_step.h"
#include "material/plausibility.h"
#include "sliding/transient/run_plan.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
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

PlausibleRange plausible_pressure(const std::string &key,
                                  const double pressure,
                                  const BodyScales &scales)
{
  const double strain = pressure / scales.stiffness;
  return {key,
          pressure,
          "Pa",
          pressure > 0. ? smallest_strain * scales.stiffness : 0.,
          "which strains the body by " + quantity_text(strain, "") +
            " only; is it in MPa? Pressures are in Pa",
          largest_strain * scales.stiffness,
          "which strains the body by " + percent(strain) +
            ", beyond small strains; is it in Pa?"};
}

/** A load with its two keys. */
struct Load
{
  const LoadHistory &history;
  const char *section, *key;

  /** For its @p which ("largest") value. */
  std::string name(const std::string &which) const
  {
    return history.is_expression()
             ? "the " + which + " value of " + section + "/Expression"
             : std::string(section) + "/" + key;
  }
};

/** Collects what is to be judged of a transient run. */
class RunJudge
{
public:
  RunJudge(const ContactParameters &p, const UniformMaterial &m)
    : parameters(p)
    , material(m)
    , scales(m)
    , end(p.time.end_time)
    , crossing(crossing_time(m))
    , run_text("the whole run (" + quantity_text(end, "s") + ")")
    , pressure{p.top.pressure, "Top", "Pressure"}
    , velocity{p.contact.flat_velocity, "Flat", "Velocity"}
    , pressures(load_range(p.top.pressure, end))
    , flat_speed(load_range(p.contact.flat_velocity, end).largest_size())
  {
    judge_times();
    judge_top();
    judge_velocities();
    judge_contact();
    judge_observation();
  }

  std::vector<std::string> sentences() const
  {
    std::vector<std::string> sentences = implausible(ranges);
    for (const Load *load : {&pressure, &velocity})
      if (!load_range(load->history, end).finite)
        sentences.push_back(std::string(load->section) +
                            "/Expression is not finite at all times of " + run_text +
                            ", which will stop it");
    if (parameters.top.kind != TopSetup::Kind::held && pressures.largest_size() == 0. &&
        parameters.body.initial_velocity == std::array<double, 2>{} &&
        parameters.step.acceleration == std::array<double, 2>{})
      sentences.push_back("Top/Pressure is 0 in " + run_text +
                          " and Body/Initial velocity and Acceleration are 0: nothing "
                          "presses the body on the flat");
    if (!(end >= 2. * crossing))
      sentences.push_back(
        crossing_text(parameters, material) +
        ": it ends before the wave is back; are Body/Size and Time/End time in "
        "m and s, and the stiffness in Pa?");
    if (const std::string damping =
          damping_warning(parameters, material, "the critical time step");
        !damping.empty())
      sentences.push_back(damping);
    if (slides_undamped())
      sentences.emplace_back(
        "the run has neither regularization (Friction/Law = coulomb or Regularization "
        "time = 0) nor damping (Time/Rayleigh beta = 0): while nodes slide, waves of "
        "three to four cells grow that the body does not have, the faster the finer the "
        "grid is, so that no grid is fine enough; set one of them, the paper has 1.5e-6 "
        "and 4.4e-9 s");
    return sentences;
  }

private:
  void add_lowest(const std::string &key,
                  const double value,
                  const std::string &unit,
                  const double lowest,
                  const std::string &if_low)
  {
    PlausibleRange range{key, value, unit};
    range.lowest = lowest;
    range.if_low = if_low;
    add(range);
  }

  void add_highest(const std::string &key,
                   const double value,
                   const std::string &unit,
                   const double highest,
                   const std::string &if_high)
  {
    PlausibleRange range{key, value, unit};
    range.highest = highest;
    range.if_high = if_high;
    add(range);
  }

  void add(const PlausibleRange &range)
  {
    if (!std::isnan(range.value)) // of an expression: told by itself
      ranges.push_back(range);
  }

  /** A duration that has to act within the run. */
  void add_within_run(const std::string &key,
                      const double value,
                      const double longest,
                      const std::string &consequence)
  {
    add_highest(key, value, "s", longest,
                "longer than " + run_text + ", so that " + consequence + "; is it in s?");
  }

  /** That a ramp is over before the run is. */
  void add_ramp(const Load &load)
  {
    const double amplitude = load.history.amplitude();
    if (!load.history.is_expression() && amplitude != 0.)
      add_lowest(std::string("The share of its load that section ") + load.section +
                   " reaches in the run",
                 load.history(end) / amplitude, "", 0.5,
                 std::string("as ") + load.section + "/Ramp time is longer than " +
                   run_text + "; is it in s?");
  }

  /** Against the speed of waves. */
  void add_speed(const std::string &key, const double speed)
  {
    add_highest(key, speed, "m/s", fastest * scales.wave_speed,
                percent(speed / scales.wave_speed) +
                  " of the speed of waves in the body, " +
                  quantity_text(scales.wave_speed, "m/s") +
                  "; is it in mm/s? Velocities are in m/s");
  }

  void judge_times()
  {
    add_highest("Time/End time", end, "s", most_crossings * crossing,
                "in which a wave crosses the body " +
                  quantity_text(end / crossing, "times") + "; is it in s?");
    if (std::isnan(parameters.step.dt))
      return;
    const double critical = critical_time_step(
      element_frequency_bound(material), parameters.step.beta2, parameters.step.beta);
    add_lowest("Time/Time step", parameters.step.dt, "s", 1e-3 * critical,
               "less than a thousandth of the critical " + quantity_text(critical, "s") +
                 "; is it in s?");
  }

  void judge_top()
  {
    const TopSetup &top = parameters.top;
    if (top.kind == TopSetup::Kind::held || !(top.hold_from > 0.))
      return;
    ranges.push_back(
      plausible_pressure(pressure.name("largest"), pressures.largest_size(), scales));
    add_ramp(pressure);
    add_lowest(pressure.name("smallest"), pressures.smallest, "Pa", 0.,
               "which pulls the body off the flat; a positive pressure presses it on");
    if (std::isfinite(top.hold_from))
      add_within_run("Top/Hold from", top.hold_from, end, "the top is never held");
    const double mass = material.total_mass();
    add_highest("Top/Platen mass", top.platen_mass, "kg/m", 1e4 * mass,
                "more than 10000 times the body's " + quantity_text(mass, "kg/m") +
                  "; is it in kg per m of thickness?");
  }

  void judge_velocities()
  {
    add_speed(velocity.name("largest"), flat_speed);
    if (flat_speed > 0.)
      add_lowest(velocity.name("largest"), flat_speed, "m/s", atom / end,
                 "with which the flat moves less than the width of an atom in " +
                   run_text + "; is it in m/s?");
    add_ramp(velocity);
    for (unsigned int d = 0; d < 2; ++d)
      add_speed("Body/Initial velocity along " + std::string(1, "xy"[d]),
                std::fabs(parameters.body.initial_velocity[d]));
  }

  void judge_contact()
  {
    // In a short run the first vibrations count, of about ten crossings.
    const double longest         = std::max(end, 10. * crossing);
    const FrictionParameters &fr = parameters.friction;
    const std::string useless    = "friction hardly comes to act";
    if (parameters.contact.law.node_law)
      add_within_run("L / (|V| + V_ref), of Friction/Length and Reference velocity at "
                     "the speed of the "
                     "flat,",
                     fr.slip_length / (flat_speed + fr.reference_velocity), longest,
                     useless);
    else
      add_within_run("Friction/Regularization time", parameters.contact.law.time, longest,
                     useless);
    // How far the body can come towards the flat, when nothing stops it.
    const double force = parameters.top.kind == TopSetup::Kind::held
                           ? 0.
                           : pressures.largest_size() * material.grid().extent(0);
    const double acceleration =
      std::fabs(parameters.step.acceleration[1]) + force / material.total_mass();
    const double furthest = std::fabs(parameters.body.initial_velocity[1]) * end +
                            0.5 * acceleration * end * end;
    add_highest(
      "Flat/Gap", parameters.contact.gap, "m", furthest,
      "but pressure, initial velocity and acceleration move the body by " +
        quantity_text(furthest, "m") +
        " at most before Time/End time: it never touches the flat; is it in m?");
  }

  void judge_observation()
  {
    const ObservationParameters &o = parameters.observation;
    const double n_steps           = largest_number_of_steps(parameters, material);
    const auto interval = [&](const std::string &key, const unsigned int steps) {
      // 200 is the default where nothing is asked for.
      add_highest("Observation/" + key, steps, "steps", std::max(200., n_steps),
                  "more than " + run_text + " has, " + quantity_text(n_steps, "steps"));
    };
    interval("History interval", parameters.history_interval);
    interval("Energy interval", parameters.energy_interval);
    if (!o.probes.empty())
      interval("Probe interval", o.probe_interval);
    if (!(o.snapshots_interval > 0.))
      return;
    add_within_run("Snapshots/Interval", o.snapshots_interval, end,
                   "there is one snapshot only");
    if (!std::isnan(o.snapshots_to))
      add_highest("Snapshots/To", o.snapshots_to, "s", 2. * end,
                  "long after the end of " + run_text + "; is it in s?");
  }

  bool slides_undamped() const
  {
    const FrictionParameters &friction = parameters.friction;
    return parameters.contact.law.time == 0. && !parameters.contact.law.node_law &&
           parameters.step.beta == 0. && parameters.step.beta2 == 0.5 &&
           (friction.coefficient_by_phase || friction.coefficient > 0.) &&
           flat_speed > 0.;
  }

  const ContactParameters &parameters;
  const UniformMaterial &material;
  const BodyScales scales;
  const double end, crossing; ///< of the run, of a wave through the body (s)
  const std::string run_text;
  const Load pressure, velocity;
  const LoadRange pressures;
  const double flat_speed; ///< largest (m/s)
  std::vector<PlausibleRange> ranges;
};
} // namespace

std::vector<std::string> implausible_static_load(const ContactParameters &parameters,
                                                 const UniformMaterial &material)
{
  const double pressure = parameters.top.pressure.amplitude();
  return implausible(
    {plausible_pressure("Top/Pressure", std::fabs(pressure), BodyScales(material))});
}

std::string crossing_text(const ContactParameters &parameters,
                          const UniformMaterial &material)
{
  return "a wave takes " + quantity_text(1e3 * crossing_time(material), "ms") +
         " from the flat to the top, the run " +
         quantity_text(1e3 * parameters.time.end_time, "ms");
}

std::vector<std::string> implausible_run(const ContactParameters &parameters,
                                         const UniformMaterial &material)
{
  return RunJudge(parameters, material).sentences();
}
} // namespace mesoslip
