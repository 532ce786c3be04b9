// Warnings of a run on results that may mislead.
#include "sliding/transient/transient_result.h"

#include "material/plausibility.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Share of a spectrum's power near its highest frequency above which it is doubtful. */
constexpr double doubtful_share = 0.01;

/** In steady sliding means exceed the coefficient by rounding and the last drift. */
constexpr double tolerated_excess = 1e-3;

std::string duration_remark(const ContactDuration &duration)
{
  if (!duration.complete() || duration.representative())
    return "";
  return brief_text(
    3, "T_G = ", duration.mean, " s rests on the ", 100. * duration.node_share,
    " % of the contact nodes that landed in the steady part; the others never left the "
    "flat and only add time, so T_G grows with the run and eq. (13) should not be used "
    "with it");
}

/** Remark on a missing steady part: the run is too short, or ended before Steady from (at
 * a limit cycle or on request). */
std::string steady_part_remark(const TransientResult &run)
{
  const std::vector<double> &time = run.series.time;
  return time.size() < TransientResult::least_samples
           ? brief_text(6, "the run has ", time.size(),
                        " samples for statistics, fewer than the ",
                        TransientResult::least_samples,
                        " that they take: mu_inter and the spectrum are left out; set a "
                        "later Time/End time")
           : brief_text(6,
                        "fewer than three samples lie between the start of the steady "
                        "part, ",
                        run.steady_from, " s, and the end, ", time.back(),
                        " s: mu_inter and the spectrum are left out; set "
                        "Observation/Steady from earlier");
}

/** Largest coefficient of all nodes; for a law that varies, up to twice the speed of the
 * flat. */
double largest_coefficient(const TransientResult &run)
{
  const std::vector<double> &of_nodes = run.body.friction;
  const double largest   = *std::max_element(of_nodes.begin(), of_nodes.end());
  const FrictionLaw &law = run.parameters.contact.law;
  const double speed     = std::fabs(run.parameters.contact.flat_velocity.amplitude());
  if (!law.coefficient_law)
    return largest;
  const double factor = law.reference > 0. ? largest / law.reference : 1.;
  return factor * law.coefficient_law->largest(2. * speed);
}

std::string friction_remark(const TransientResult &run)
{
  if (!run.mu_inter && run.load_meaning.empty())
    return "";
  if (!run.mu_inter)
    return brief_text(
      4, "mu_inter is left out: the mean of F_N |V| in the steady part is ",
      run.load_power, run.body.unit(" W"),
      ", so that there is no load along the way of the flat to relate the frictional "
      "power to");
  // Judged with the lower end of the confidence interval.
  const double largest = largest_coefficient(run),
               least   = std::fabs(run.mu_inter->value) - run.mu_inter->half_width;
  if (least <= (1. + tolerated_excess) * largest)
    return "";
  return brief_text(
    4, "mu_inter = ", run.mu_inter->value, " is above the largest friction coefficient, ",
    largest,
    ": the contact moves faster than the flat, whose velocity alone mu_inter takes into "
    "account",
    run.parameters.contact.law.time > 0.
      ? ", or friction lags behind the pressure (Friction/Regularization time)"
      : "",
    "; it is not a friction coefficient of this motion");
}

/** Remark on friction that falls faster than the time steps resolve. */
std::string weakening_remark(const TransientResult &run)
{
  if (!(run.largest_weakening >= 1.))
    return "";
  return brief_text(
    3, "friction fell up to ", run.largest_weakening,
    " times as fast with slip rate or slip as the mass of a contact node can resist "
    "within "
    "a time step: where it did, slip began with a jump that depends on grid and step; a "
    "larger critical velocity or slip of Friction/Coefficient law, a finer grid with its "
    "shorter step, or a lower pressure avoid that");
}

/** Remark on steps in which the friction of two bodies had no solution. */
std::string settling_remark(const TransientResult &run)
{
  if (run.settling.unsettled == 0)
    return "";
  return brief_text(
    3, "in ", static_cast<double>(run.settling.unsettled), " of ",
    static_cast<double>(run.steps_done),
    " steps friction between the two bodies jumped to and fro, as a node that begins to "
    "stick moves its neighbours: there forces are off by up to ",
    run.settling.change,
    " of the largest one; nodes of both bodies that match, or Friction/Law = coulomb, "
    "avoid that");
}

/** Remark on frequencies that the samples of the statistics do not resolve. */
std::string spectrum_remark(const TransientResult &run)
{
  const double limit = 5e-4 / run.series.interval; // kHz
  if (run.hidden_share > 0.5)
    return brief_text(3, 100. * run.hidden_share,
                      " % of the motion of the reference node is faster than the ", limit,
                      " kHz that the samples kept of so long a run can carry: there is "
                      "no main frequency; reduce Time/End time");
  if (run.folded_share > doubtful_share)
    return brief_text(
      3, 100. * run.folded_share,
      " % of the power of the reference node's motion lies between ", 0.9 * limit,
      " and ", limit,
      " kHz, the highest frequency that its samples can carry: faster motion shows up at "
      "lower frequencies, and the main frequency may be wrong; is the motion that of the "
      "grid, for want of Time/Rayleigh beta?");
  if (run.frequencies &&
      run.frequencies->slow_amplitude > run.frequencies->main_amplitude)
    return brief_text(
      3, "the reference node moves more at less than ",
      1e-3 * run.spectrum.lowest_frequency(),
      " kHz, of which the steady part has not two periods, than at the main frequency: "
      "it drifts, or vibrates more slowly than a run of this length can tell; set "
      "Time/End time or Observation/Steady from later");
  return "";
}

/** Remark on histories with aliased vibrations. */
std::string history_remark(const TransientResult &run)
{
  unsigned int interval = run.time.interval(run.parameters.history_interval);
  if (!run.parameters.observation.probes.empty())
    interval = std::max(interval, run.time.interval(run.parameters.probe_interval));
  if (!run.frequencies || interval == run.time.statistics_interval)
    return "";
  const double highest = run.frequencies->highest_frequency, dt = run.time.step.dt;
  if (interval <= 0.5 / (highest * dt)) // shorter than half a period
    return "";
  return brief_text(
    4, "the reference node vibrates at up to ", 1e-3 * highest, " kHz (main frequency ",
    1e-3 * run.frequencies->main_frequency,
    " kHz), but histories and probes in dynamics.h5, samples every ", interval,
    " steps, carry up to ", 5e-4 / (interval * dt),
    " kHz: their spectra would show frequencies that are not there; leave "
    "Observation/History interval and Probe interval at auto");
}

/** Remark on a contact map with aliased waves. */
std::string map_remark(const TransientResult &run)
{
  const ContactMapSetup map = contact_map_setup(run.parameters, run.time.step.dt);
  if (map.interval == 0 || !run.frequencies)
    return "";
  const double spacing   = static_cast<double>(map.interval) * run.time.step.dt,
               frequency = run.frequencies->main_frequency;
  if (spacing <= 0.5 / frequency)
    return "";
  return brief_text(4, "the map of the contact has samples every ", spacing,
                    " s, more than half a period of the main frequency, ",
                    1e-3 * frequency,
                    " kHz: waves in it are slower than, or against, what there is; set "
                    "Contact map/Interval to at most ",
                    0.1 / frequency, " s, a tenth of a period");
}

/** Displacements that are large for the strains: single precision carries seven digits of them. */
std::string precision_remark(const TransientResult &run)
{
  constexpr double doubtful = 1e-4;
  if (!(run.rounded_share() > doubtful))
    return "";
  return brief_text(
    2, "single precision rounds strains by up to ", 100. * run.rounded_share(),
    " % of the largest one, as nodes are far from where they started: the "
    "results are off by as much or more; set Time/Precision = double");
}

std::string separation_remark(const TransientResult &run)
{
  if (run.contact.node_shares.empty() || run.contact.shares.separation < 1.)
    return "";
  const TopSetup &top       = run.parameters.top;
  const double pressure     = top.pressure.amplitude();
  const std::string touched = "no node touched the flat in the steady part";
  return top.is_held() || pressure > 0.
           ? touched
           : brief_text(
               6, touched, ": Supports/Top/Pressure is ", pressure, " Pa, which ",
               pressure < 0. ? "pulls the body off the flat; a positive one presses"
                             : "presses nothing");
}
} // namespace

void TransientResult::add_remarks()
{
  duration_warning = duration_remark(contact.duration);
  friction_warning = has_statistics ? friction_remark(*this) : steady_part_remark(*this);
  for (const std::string &text :
       {spectrum_remark(*this), history_remark(*this), map_remark(*this),
        separation_remark(*this), weakening_remark(*this), settling_remark(*this),
        precision_remark(*this)})
    if (!text.empty())
      warnings.push_back(text);
}
} // namespace mesoslip
