#include "dynamics/critical_time_step.h"
#include "sliding/friction/rate_weakening.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
// Largest plausible speed over the wave speed: 250 m/s in the paper's pin.
constexpr double fastest = 0.05;
// Crossings of the body by a wave: 3 ms in a pin of 16 mm are a thousand.
constexpr double most_crossings = 1e5;
constexpr double atom           = 1e-10; // m

std::string percent(const double share)
{
  return quantity_text(100. * share, "%");
}

PlausibleRange at_most(const std::string &key,
                       const double value,
                       const std::string &unit,
                       const double highest,
                       const std::string &if_high)
{
  return {key, value, unit, PlausibleRange().lowest, "", highest, if_high};
}

/** A load with its section and key. */
struct Load
{
  const LoadHistory &history;
  const std::string section, key;

  /** Name in texts of its @p which ("largest") value. */
  std::string name(const std::string &which) const
  {
    return history.is_expression()
             ? "the " + which + " value of " + section + "/Expression"
             : section + "/" + key;
  }
};

/** Judges the keys of a transient run for plausibility. */
class RunJudge
{
public:
  RunJudge(const ContactParameters &p, const BodyScales &scales, const double n_steps)
    : parameters(p)
    , scales(scales)
    , n_steps(n_steps)
    , end(p.time.end_time)
    , crossing(scales.crossing())
    , run_text("the whole run (" + quantity_text(end, "s") + ")")
    , pressure{p.top.pressure, "Supports/Top", "Pressure"}
    , velocity{p.contact.flat_velocity, "Flat", "Velocity"}
    , pressures(load_range(p.top.pressure, end))
    , flat_speed(load_range(p.contact.flat_velocity, end).largest_size())
    , is_pushed(p.is_moved_normally() || p.contact.profile)
  {
  }

  std::vector<std::string> sentences() const
  {
    std::vector<PlausibleRange> ranges;
    for (const auto &some : {times(), top(), velocities(), contact(), observation()})
      for (const PlausibleRange &range : some)
        if (!std::isnan(range.value)) // expressions are judged below; NaN: not requested
          ranges.push_back(range);
    std::vector<std::string> sentences = implausible(ranges);
    for (const Load *load : {&pressure, &velocity})
      if (!load_range(load->history, end).finite)
        sentences.push_back(load->section + "/Expression is not finite at all times of " +
                            run_text + ", which will stop it");
    if (!parameters.top.is_held() && pressures.largest_size() == 0. && !is_pushed &&
        parameters.body.initial_velocity == std::array<double, 3>{} &&
        !parameters.step.is_heavy())
      sentences.push_back("Supports/Top/Pressure is 0 in " + run_text +
                          " and Body/Initial velocity and Acceleration are 0: nothing "
                          "presses the body on the flat");
    if (!(end >= 2. * crossing))
      sentences.push_back(crossing_text(parameters, scales) +
                          ": it ends before the wave is back; are " +
                          parameters.mesh.size_key() +
                          " and Time/End time in m and s, and the stiffness in Pa?");
    if (const std::string damping =
          damping_warning(parameters, scales, "the critical time step");
        !damping.empty())
      sentences.push_back(damping);
    if (const std::string weakening = weakening_text(); !weakening.empty())
      sentences.push_back(weakening);
    if (slides_undamped())
      sentences.emplace_back(
        "the run has neither regularization (Friction/Law = coulomb or Regularization "
        "time = 0) nor damping (Time/Rayleigh beta = 0, or 0 in a phase): while nodes "
        "slide, waves of "
        "three to four cells grow that the body does not have, the faster the finer the "
        "grid is, so that no grid is fine enough; set one of them, the paper has 1.5e-6 "
        "and 4.4e-9 s");
    return sentences;
  }

private:
  using Ranges = std::vector<PlausibleRange>;

  /** Range of a duration that has to act within the run. */
  PlausibleRange within_run(const std::string &key,
                            const double value,
                            const double longest,
                            const std::string &consequence) const
  {
    return at_most(key, value, "s", longest,
                   "longer than " + run_text + ", so that " + consequence +
                     "; times are in s");
  }

  /** Checks that a ramp ends within the run. */
  PlausibleRange ramp(const Load &load) const
  {
    const double amplitude = load.history.amplitude();
    return {"The share of its load that section " + load.section + " reaches in the run",
            load.history.is_expression() || amplitude == 0.
              ? automatic
              : load.history(end) / amplitude,
            "", 0.5,
            "as " + load.section + "/Ramp time is longer than " + run_text +
              "; times are in s"};
  }

  /** Range of a speed relative to the wave speed. */
  PlausibleRange speed(const std::string &key, const double value) const
  {
    return at_most(key, value, "m/s", fastest * scales.wave_speed,
                   percent(value / scales.wave_speed) +
                     " of the speed of waves in the body, " +
                     quantity_text(scales.wave_speed, "m/s") +
                     "; is it in mm/s? Velocities are in m/s");
  }

  Ranges times() const
  {
    const StepParameters &step = parameters.step;
    const double critical =
      critical_time_step(scales.highest_frequency, step.beta2, step.beta);
    return {at_most("Time/End time", end, "s", most_crossings * crossing,
                    "in which a wave crosses the body " +
                      quantity_text(end / crossing, "times") + "; times are in s"),
            {"Time/Time step", step.dt, "s", 1e-3 * critical,
             "less than a thousandth of the critical " + quantity_text(critical, "s") +
               "; times are in s"}};
  }

  Ranges top() const
  {
    const TopSetup &top = parameters.top;
    if (top.is_held())
      return {};
    PlausibleRange hold = within_run("Supports/Top/Hold from",
                                     std::isfinite(top.hold_from) ? top.hold_from : end,
                                     end, "the top is never held");
    hold.lowest         = std::numeric_limits<double>::min();
    hold.if_low         = "so that Supports/Top/Pressure never acts";
    // The effect of a ramp that outlasts the run has a message of its own.
    const LoadRange all =
      load_range(top.pressure, std::max(end, top.pressure.duration()));
    return {
      plausible_pressure(pressure.name("largest"), all.largest_size(), scales.stiffness),
      ramp(pressure),
      {pressure.name("smallest"), pressures.smallest, "Pa", 0.,
       "which pulls the body off the flat; a positive pressure presses it on"},
      hold};
  }

  Ranges velocities() const
  {
    const std::array<double, 3> &initial = parameters.body.initial_velocity;
    Ranges ranges                        = {speed(velocity.name("largest"), flat_speed),
                                            {velocity.name("largest"), flat_speed, "m/s",
                      flat_speed > 0. ? atom / end : 0.,
                                             "with which the flat moves less than the width of an atom in " +
                                               run_text + "; velocities are in m/s"},
                                            ramp(velocity)};
    for (unsigned int c = 0; c < scales.dim; ++c)
      ranges.push_back(speed(std::string("Body/Initial velocity along ") + "xyz"[c],
                             std::fabs(initial[c])));
    const CoefficientLawParameters &law = parameters.friction.coefficient_law;
    if (law.kind == CoefficientLawParameters::Kind::static_and_kinetic ||
        law.kind == CoefficientLawParameters::Kind::stribeck)
      ranges.push_back(
        speed("Friction/Critical velocity", law.stribeck.critical_velocity));
    return ranges;
  }

  Ranges contact() const
  {
    // In a short run the first vibrations matter, about ten crossings.
    const double longest         = std::max(end, 10. * crossing);
    const FrictionParameters &fr = parameters.friction;
    const std::string useless    = "friction hardly comes to act";
    // Distance that the body can move towards the flat if it is not stopped.
    const double force =
      parameters.top.is_held() ? 0. : pressures.largest_size() * scales.area;
    const unsigned int normal = scales.dim - 1;
    const double acceleration =
      std::fabs(parameters.step.acceleration[normal]) + force / scales.mass;
    const double furthest = std::fabs(parameters.body.initial_velocity[normal]) * end +
                            0.5 * acceleration * end * end;
    return {
      parameters.contact.law.node_law
        ? within_run("L / (|V| + V_ref), of Friction/Length and Reference velocity "
                     "at the speed of the flat,",
                     fr.slip_length / (flat_speed + fr.reference_velocity), longest,
                     useless)
        : within_run("Friction/Regularization time", parameters.contact.law.time, longest,
                     useless),
      at_most("Friction/Regularization time",
              parameters.contact.law.time <= longest ? parameters.contact.law.time : 0.,
              "s", crossings_of_a_period * crossing,
              "longer than a vibration of the body lasts, some " +
                quantity_text(crossings_of_a_period * crossing, "s") +
                ", so that friction does not follow it; times are in s"),
      plausible_friction("the largest friction coefficient, of Friction/Coefficient law "
                         "at the speed of the flat,",
                         largest_coefficient_of_law()),
      weakening_slip(),
      within_run("Friction/Normal stress time", parameters.contact.law.normal_stress.time,
                 longest, useless),
      at_most(
        "Flat/Gap", is_pushed ? 0. : parameters.contact.gap, "m", furthest,
        "but pressure, initial velocity and acceleration move the body by " +
          quantity_text(furthest, "m") +
          " at most before Time/End time: it never touches the flat; lengths are in m")};
  }

  /** Range of the critical slip of a law that changes with the slip: at most ten times
   * the flat's way. */
  PlausibleRange weakening_slip() const
  {
    const CoefficientLawParameters &law = parameters.friction.coefficient_law;
    const bool by_state = law.kind == CoefficientLawParameters::Kind::rate_and_state;
    const double way    = flat_speed * end;
    return at_most(by_state ? "Friction/Rate and state/Length" : "Friction/Critical slip",
                   by_state                  ? law.state.length
                   : law.is_slip_weakening() ? law.weakening.critical_slip
                                             : automatic,
                   "m", way > 0. ? 10. * way : PlausibleRange().highest,
                   "more than ten times what the flat moves in " + run_text + ", " +
                     quantity_text(way, "m") +
                     ", so that friction hardly changes; lengths are in m");
  }

  /** NaN without a law. */
  double largest_coefficient_of_law() const
  {
    const FrictionLaw &law             = parameters.contact.law;
    const FrictionParameters &friction = parameters.friction;
    if (!law.coefficient_law ||
        (friction.coefficient_by_phase && friction.coefficient_law.has_reference()))
      return automatic;
    const double largest = law.coefficient_law->largest(flat_speed);
    return std::isfinite(largest) ? largest
                                  : automatic; // may depend on more than the slip
  }

  Ranges observation() const
  {
    const ObservationParameters &o = parameters.observation;
    const auto interval            = [&](const std::string &key, const double steps) {
      // 200 is the default if the key is not set.
      return at_most("Observation/" + key, steps, "steps", std::max(200., n_steps),
                                "more than " + run_text + " has, " +
                                  quantity_text(n_steps, "steps"));
    };
    const bool snapshots = o.snapshots_interval > 0.;
    return {interval("History interval", parameters.history_interval),
            interval("Energy interval", parameters.energy_interval),
            interval("Probe interval", o.probes.empty() ? 0 : parameters.probe_interval),
            within_run("Snapshots/Interval", o.snapshots_interval, end,
                       "there is one snapshot only"),
            at_most("Snapshots/To", snapshots ? o.snapshots_to : automatic, "s", 2. * end,
                    "long after the end of " + run_text + "; times are in s")};
  }

  /** If friction falls with the slip rate by more than waves radiate, all wave lengths
   * grow, the shortest fastest. */
  std::string weakening_text() const
  {
    const FrictionLaw &law = parameters.contact.law;
    if (!law.coefficient_law || law.time > 0. || law.node_law || flat_speed == 0.)
      return "";
    SlipPoint at;
    at.slip_rate                 = flat_speed;
    at.pressure                  = pressures.largest_size();
    at.state                     = law.coefficient_law->steady_state(flat_speed);
    const RateWeakening friction = {
      at.pressure *
        std::max(law.coefficient_law->steepest_fall(), -law.coefficient_law->slope(at)),
      scales.shear_impedance, 0., parameters.step.least_beta()};
    if (!friction.is_too_steep())
      return "";
    const double growth = friction.fastest_growth();
    return "friction " + friction.text("under " + pressure.name("largest")) +
           ": slip jumps at once, and vibrations grow " +
           (std::isfinite(growth)
              ? "by up to " + quantity_text(growth, "1/s") +
                  ", which Time/Rayleigh beta alone limits"
              : std::string("the faster the shorter they are, so that no grid is fine "
                            "enough")) +
           "; use a larger Friction/Critical velocity, a regularization (Friction/Law), "
           "or a lower pressure";
  }

  bool slides_undamped() const
  {
    const FrictionParameters &friction = parameters.friction;
    return parameters.contact.law.time == 0. && !parameters.contact.law.node_law &&
           !parameters.contact.law.normal_stress.is_given() &&
           parameters.step.least_beta() == 0. && parameters.step.beta2 == 0.5 &&
           (friction.coefficient_by_phase || friction.coefficient > 0.) &&
           flat_speed > 0.;
  }

  const ContactParameters &parameters;
  const BodyScales &scales;
  const double n_steps;
  const double end, crossing; ///< run time, and crossing time of a wave (s)
  const std::string run_text;
  const Load pressure, velocity;
  const LoadRange pressures;
  const double flat_speed; ///< largest (m/s)
  const bool is_pushed;    ///< whether a far end moves the top along the normal
};
} // namespace

std::vector<std::string> implausible_run(const ContactParameters &parameters,
                                         const BodyScales &scales,
                                         const double n_steps)
{
  return RunJudge(parameters, scales, n_steps).sentences();
}
} // namespace mesoslip
