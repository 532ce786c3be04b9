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
 * Share by which the mean force on the flat may differ from the nominal load. Under the
 * nominal load they differ by the change of the body's momentum over the length of the
 * window.
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

/** Share of the motion's variance within the averaged values of the series. */
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
 * P S |V| (W/m) if a constant pressure is the only load and the flat moves at constant
 * velocity; otherwise 0.
 */
double nominal_load(const TransientResult &run, const double begin, const double end)
{
  const TopSetup &top         = run.parameters.top;
  const LoadHistory &velocity = run.parameters.contact.flat_velocity;
  const bool pressed          = !top.is_held() && top.hold_from > end &&
                       !top.suspension.resists(run.body.dim - 1) &&
                       !top.suspension.traction.acts(run.body.dim - 1) &&
                       !run.parameters.sides_carry_normally() &&
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

/** Amplitude relative to the displacement below which a vibration is round-off. */
constexpr double rounding_noise = 1e-10;
} // namespace

void TransientResult::evaluate_reference_node()
{
  const std::size_t first      = series.first(steady_from);
  const std::vector<double> ux = tail(series.displacement, first),
                            vx = tail(series.velocity, first);
  has_statistics               = series.time.size() >= least_samples && ux.size() >= 3;
  if (ux.size() < least_samples)
    return;

  const auto [least, most] = std::minmax_element(vx.begin(), vx.end());
  velocity_amplitude       = 0.5 * (*most - *least);
  spectrum                 = amplitude_spectrum(ux, series.interval);
  hidden_share             = share_within(ux, tail(series.displacement_variance, first));
  folded_share             = share_near_limit(spectrum);
  // If more is hidden, aliases of fast motion could pass for a slow one.
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

// mu_inter refers to the work of the nominal load, or of the forces that acted.
void TransientResult::evaluate_friction()
{
  if (!has_statistics)
    return;
  const MeanWindow window       = {steady_from,
                             frequencies ? 1. / frequencies->main_frequency : 0.};
  const Estimate acted          = mean_power(series.time, series.load_work, window);
  const double nominal          = nominal_load(*this, acted.begin, acted.end);
  std::vector<double> load_work = series.load_work;
  // Without contact, the work of earlier steps leaves round-off.
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
  if (energy.time.size() < 2) // a balance needs a second sample
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
    {energy.supports, "the energy in the supports"},
    {energy.dashpots, "the energy lost in dashpots"},
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
  apparent_friction = parameters.friction_is_at_top()
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
} // namespace mesoslip
