#include "sliding/transient/transient_result.h"

#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mesoslip
{
namespace
{
/** Hz; in a spectrum with frequencies above half of it, twice the highest one. */
constexpr double least_spectrum_cut = 1e6;

/**
 * Share by which the mean force on the flat may differ from the nominal load. While that
 * acts they differ by the change of the body's momentum, over the length of the window.
 */
constexpr double nominal_tolerance = 0.05;

template <typename T>
std::vector<T> tail(const std::vector<T> &values, const std::size_t first)
{
  return std::vector<T>(values.begin() + std::min(first, values.size()), values.end());
}

double mean(const std::vector<double> &values)
{
  return std::accumulate(values.begin(), values.end(), 0.) /
         static_cast<double>(values.size());
}

/** Share of the motion's variance that is within the values of the series, means of it. */
double share_within(const std::vector<double> &means,
                    const std::vector<double> &variances_within)
{
  const double within = mean(variances_within), centre = mean(means);
  double between = 0.;
  for (const double x : means)
    between += (x - centre) * (x - centre) / static_cast<double>(means.size());
  return within > 0. ? within / (within + between) : 0.;
}

/**
 * P S |V| (W/m) while a constant pressure is all that presses on the flat, which moves at
 * a constant velocity; otherwise 0.
 */
double nominal_load(const TransientResult &run, const double begin, const double end)
{
  const TopSetup &top         = run.parameters.top;
  const LoadHistory &velocity = run.parameters.contact.flat_velocity;
  const bool pressed          = top.kind != TopSetup::Kind::held && top.hold_from > end &&
                       run.parameters.step.acceleration[run.body.dim - 1] == 0.;
  return pressed && top.pressure.is_constant_from(begin) &&
             velocity.is_constant_from(begin)
           ? top.pressure(begin) * run.body.top_area * std::fabs(velocity(begin))
           : 0.;
}

double largest(const std::vector<double> &values)
{
  double result = 0.;
  for (const double x : values)
    result = std::max(result, std::fabs(x));
  return result;
}

/** Share of a spectrum's power near its highest frequency that makes it doubtful. */
constexpr double doubtful_share = 0.01;

/** Of a vibration, as a share of the displacement, below which it is none. */
constexpr double rounding_noise = 1e-10;

/** Means of steady sliding are above the coefficient by rounding and the last drift. */
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

/** A short run, or one that ended before Steady from, at a limit cycle or on request. */
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

/** Of all nodes; of a law that varies up to twice the speed of the flat. */
double largest_coefficient(const TransientResult &run)
{
  const double of_nodes  = largest(run.body.friction);
  const FrictionLaw &law = run.parameters.contact.law;
  const double speed     = std::fabs(run.parameters.contact.flat_velocity.amplitude());
  if (!law.slip_law)
    return of_nodes;
  const double factor = law.reference > 0. ? of_nodes / law.reference : 1.;
  return factor * law.slip_law->largest(2. * speed);
}

std::string friction_remark(const TransientResult &run)
{
  if (!run.mu_inter && run.load_meaning.empty())
    return "";
  if (!run.mu_inter)
    return brief_text(
      4, "mu_inter is left out: the mean of F_N |V| in the steady part is ",
      run.load_power, run.body.unit(" W"),
      ", so that there is no load along the way of the flat to relate it to");
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

/** Friction that falls faster than the steps follow. */
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

/** Frequencies that the samples of the statistics cannot tell. */
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

/** Histories that show slower vibrations than there are. */
std::string history_remark(const TransientResult &run)
{
  unsigned int interval = run.time.interval(run.parameters.history_interval);
  if (!run.parameters.observation.probes.empty())
    interval = std::max(interval, run.time.interval(run.parameters.probe_interval));
  if (!run.frequencies || interval == run.time.statistics_interval)
    return "";
  const double highest = run.frequencies->highest_frequency, dt = run.time.step.dt;
  if (interval <= 0.5 / (highest * dt)) // half a period
    return "";
  return brief_text(
    4, "the reference node vibrates at up to ", 1e-3 * highest, " kHz (main frequency ",
    1e-3 * run.frequencies->main_frequency,
    " kHz), but histories and probes in dynamics.h5, samples every ", interval,
    " steps, carry up to ", 5e-4 / (interval * dt),
    " kHz: their spectra would show frequencies that are not there; leave "
    "Observation/History interval and Probe interval at auto");
}

/** A map of the contact that shows slower waves than there are. */
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

std::string separation_remark(const TransientResult &run)
{
  if (run.contact.node_shares.empty() || run.contact.shares.separation < 1.)
    return "";
  const TopSetup &top       = run.parameters.top;
  const double pressure     = top.pressure.amplitude();
  const std::string touched = "no node touched the flat in the steady part";
  return top.kind == TopSetup::Kind::held || pressure > 0.
           ? touched
           : brief_text(6, touched, ": Top/Pressure is ", pressure, " Pa, which ",
                        pressure < 0.
                          ? "pulls the body off the flat; a positive one presses"
                          : "presses nothing");
}
} // namespace

void TransientResult::evaluate_reference_node()
{
  const std::size_t first      = series.first(steady_from);
  const std::vector<double> ux = tail(series.displacement, first),
                            vx = tail(series.velocity, first);
  has_statistics               = series.time.size() >= least_samples && ux.size() >= 3;
  if (ux.size() < least_samples)
    return;

  spectrum     = amplitude_spectrum(ux, series.interval);
  hidden_share = share_within(ux, tail(series.displacement_variance, first));
  folded_share = share_near_limit(spectrum);
  // Beyond it what the means leave of a fast motion could pass for a slow one.
  if (hidden_share <= 0.5)
    frequencies = summarize_spectrum(spectrum, rounding_noise * largest(ux));
  std::vector<double> &frequency = spectrum.frequency;
  const double highest =
    std::max(least_spectrum_cut, frequencies ? 2. * frequencies->highest_frequency : 0.);
  frequency.erase(std::upper_bound(frequency.begin(), frequency.end(), highest),
                  frequency.end());
  spectrum.amplitude.resize(frequency.size());
  phase_diagram = mean_phase_diagram(ux, vx, series.interval,
                                     frequencies ? 1. / frequencies->main_frequency : 0.);
}

// mu_inter is over the work of the nominal load, or of the forces that acted.
void TransientResult::evaluate_friction()
{
  if (!has_statistics)
    return;
  const MeanWindow window       = {steady_from,
                             frequencies ? 1. / frequencies->main_frequency : 0.};
  const Estimate acted          = mean_power(series.time, series.load_work, window);
  const double nominal          = nominal_load(*this, acted.begin, acted.end);
  std::vector<double> load_work = series.load_work;
  // Where nothing touches, the work of before leaves round-off.
  const double work = acted.value * (acted.end - acted.begin);
  load_power        = work > 1e-9 * largest(series.load_work) ? acted.value : 0.;
  load_meaning      = "the mean of F_N |V|";
  if (std::fabs(acted.value - nominal) <= nominal_tolerance * nominal)
    {
      load_power   = nominal;
      load_meaning = "P S |V|";
      load_work    = series.time;
      for (double &value : load_work)
        value *= nominal;
    }
  if (load_power > 0. && std::isfinite(load_power))
    mu_inter = interface_friction_coefficient(series.time, series.friction_energy,
                                              load_work, window);
  if (mu_inter && !std::isfinite(mu_inter->value))
    mu_inter.reset();
  if (std::any_of(series.apparent_friction.begin(), series.apparent_friction.end(),
                  [](const double x) { return x != 0.; }))
    mean_apparent_friction = window_mean(series.time, series.apparent_friction, window);
}

void TransientResult::evaluate_energy()
{
  if (energy.time.size() < 2) // the start alone checks nothing
    return;
  const double friction = largest(energy.friction);
  std::pair<double, const char *> scale{friction, "the frictional work"};
  std::vector<double> of_body = energy.kinetic;
  for (std::size_t k = 0; k < of_body.size(); ++k)
    of_body[k] += energy.elastic[k];
  const std::pair<const std::vector<double> &, const char *> others[] = {
    {of_body, "the energy in the body"},
    {energy.potential, "the work of the body forces"},
    {energy.external_work, "the work of the loads"},
    {energy.impact, "the impact energy"},
    {energy.damping, "the damped energy"},
    {energy.scheme, "the energy that the scheme dissipates"}};
  for (const auto &[term, name] : others)
    if (const double size = largest(term); friction < 0.1 * size && scale.first < size)
      scale = {size, name};
  residual_scale = scale.second;
  if (scale.first > 0.)
    energy_residual = largest(energy.residual()) / scale.first;
}

void TransientResult::evaluate()
{
  apparent_friction = parameters.top.holds_tangentially()
                        ? quotients(top.tangential_force, top.normal_force)
                        : quotients(history.tangential_force, history.normal_force);
  evaluate_reference_node();
  evaluate_friction();
  evaluate_energy();
  if (!blocks.empty())
    {
      contact =
        summarize_contact(blocks, body.n_contact_nodes, time.step.dt, steady_from);
      reference_shares = contact.node_shares[std::min<std::size_t>(
        body.reference.number, body.n_contact_nodes - 1)];
      regime           = regime_label(reference_shares);
    }
  add_remarks();
}

void TransientResult::add_remarks()
{
  duration_warning = duration_remark(contact.duration);
  friction_warning = has_statistics ? friction_remark(*this) : steady_part_remark(*this);
  for (const std::string &text :
       {spectrum_remark(*this), history_remark(*this), map_remark(*this),
        separation_remark(*this), weakening_remark(*this)})
    if (!text.empty())
      warnings.push_back(text);
}
} // namespace mesoslip
