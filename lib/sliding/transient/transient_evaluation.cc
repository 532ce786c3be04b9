#include "sliding/transient/transient_summary.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace mesoslip
{
namespace
{
constexpr double spectrum_cut = 1e6; // Hz

/**
 * Share by which the mean force on the flat may differ from the nominal load. While that
 * acts they differ by the change of the body's momentum, over the length of the window.
 */
constexpr double nominal_tolerance = 0.05;

std::vector<double> apparent_friction(const ContactParameters &parameters,
                                      const TransientObservations &observed)
{
  const bool at_the_top = transmits_tangential_force(parameters.top);
  const auto &tangential =
    at_the_top ? observed.top.tangential_force : observed.contact.tangential_force;
  const auto &normal =
    at_the_top ? observed.top.normal_force : observed.contact.normal_force;
  std::vector<double> ratio(std::min(tangential.size(), normal.size()));
  for (std::size_t k = 0; k < ratio.size(); ++k)
    ratio[k] = normal[k] != 0. ? tangential[k] / normal[k] : 0.;
  return ratio;
}

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

/** Share of the motion's variance that is within the values of the series, whose mean
 * they are. */
double hidden_share(const std::vector<double> &means,
                    const std::vector<double> &variances_within)
{
  const double within = mean(variances_within), centre = mean(means);
  double between = 0.;
  for (const double x : means)
    between += (x - centre) * (x - centre) / static_cast<double>(means.size());
  return within > 0. ? within / (within + between) : 0.;
}

void evaluate_reference_node(const TransientObservations &observed,
                             TransientSummary &summary)
{
  const SteadySeries &series   = observed.series;
  const std::size_t first      = series.first(observed.steady_from);
  const std::vector<double> ux = tail(series.displacement, first),
                            vx = tail(series.velocity, first);
  summary.has_statistics =
    series.time.size() >= TransientSummary::least_samples && ux.size() >= 3;
  if (ux.size() < TransientSummary::least_samples)
    return;

  summary.spectrum     = amplitude_spectrum(ux, series.interval);
  summary.hidden_share = hidden_share(ux, tail(series.displacement_variance, first));
  summary.folded_share = share_near_limit(summary.spectrum);
  // Beyond it what the means leave of a fast motion could pass for a slow one.
  if (summary.hidden_share <= 0.5)
    summary.frequencies = summarize_spectrum(summary.spectrum, 1e-15);
  auto &[frequency, amplitude] = summary.spectrum;
  const auto cut = std::upper_bound(frequency.begin(), frequency.end(), spectrum_cut);
  frequency.erase(cut, frequency.end());
  amplitude.resize(frequency.size());
  summary.phase_diagram = mean_phase_diagram(ux, vx, series.interval, summary.period());
}

/**
 * P S |V| (W/m) while a constant pressure is all that presses on the flat, which moves at
 * a constant velocity; otherwise 0.
 */
double nominal_load(const ContactParameters &parameters,
                    const BodyDescription &body,
                    const double begin,
                    const double end)
{
  const LoadHistory &pressure = parameters.top.pressure,
                    &velocity = parameters.contact.flat_velocity;
  const bool pressed          = parameters.top.kind != TopSetup::Kind::held &&
                       parameters.top.hold_from > end &&
                       parameters.step.acceleration[1] == 0.;
  return pressed && pressure.is_constant_from(begin) && velocity.is_constant_from(begin)
           ? pressure(begin) * body.grid.extent(0) * std::fabs(velocity(begin))
           : 0.;
}

/** What mu_inter is over: the work of the nominal load, or of the forces that acted. */
std::vector<double> evaluate_load(const ContactParameters &parameters,
                                  const BodyDescription &body,
                                  const SteadySeries &series,
                                  const MeanWindow &window,
                                  TransientSummary &summary)
{
  const Estimate acted = mean_power(series.time, series.load_work, window);
  const double nominal = nominal_load(parameters, body, acted.begin, acted.end);
  summary.load_power   = acted.value;
  summary.load_meaning = "the mean of F_N |V|";
  if (!(std::fabs(acted.value - nominal) <= nominal_tolerance * nominal))
    return series.load_work;
  summary.load_power       = nominal;
  summary.load_meaning     = "P S |V|";
  std::vector<double> work = series.time;
  for (double &value : work)
    value *= nominal;
  return work;
}

void evaluate_friction(const ContactParameters &parameters,
                       const BodyDescription &body,
                       const TransientObservations &observed,
                       TransientSummary &summary)
{
  const SteadySeries &series = observed.series;
  if (!summary.has_statistics)
    return;
  const MeanWindow window = {observed.steady_from, summary.period()};
  const std::vector<double> load_work =
    evaluate_load(parameters, body, series, window, summary);
  if (summary.load_power > 0. && std::isfinite(summary.load_power))
    summary.mu_inter = interface_friction_coefficient(series.time, series.friction_energy,
                                                      load_work, window);
  if (summary.mu_inter && !std::isfinite(summary.mu_inter->value))
    summary.mu_inter.reset();
  if (std::any_of(series.apparent_friction.begin(), series.apparent_friction.end(),
                  [](const double x) { return x != 0.; }))
    summary.mean_apparent_friction =
      window_mean(series.time, series.apparent_friction, window);
}

double largest(const std::vector<double> &values)
{
  double result = 0.;
  for (const double x : values)
    result = std::max(result, std::fabs(x));
  return result;
}

void evaluate_energy(const TransientObservations &observed, TransientSummary &summary)
{
  const EnergyHistory &e = observed.energy;
  if (!observed.contact.friction_energy.empty())
    summary.friction_energy = observed.contact.friction_energy.back();
  if (e.time.size() < 2) // the start alone checks nothing
    return;
  const double friction = largest(e.friction);
  std::pair<double, const char *> scale{friction, "the frictional work"};
  std::vector<double> energy = e.kinetic;
  for (std::size_t k = 0; k < energy.size(); ++k)
    energy[k] += e.elastic[k];
  const std::pair<const std::vector<double> &, const char *> others[] = {
    {energy, "the energy in the body"},
    {e.potential, "the work of the body forces"},
    {e.external_work, "the work of the loads"},
    {e.impact, "the impact energy"},
    {e.damping, "the damped energy"},
    {e.scheme, "the energy that the scheme dissipates"}};
  for (const auto &[term, name] : others)
    if (const double size = largest(term); friction < 0.1 * size && scale.first < size)
      scale = {size, name};
  summary.residual_scale = scale.second;
  if (scale.first > 0.)
    summary.energy_residual = largest(e.residual()) / scale.first;
}
} // namespace

TransientSummary summarize_transient(const ContactParameters &parameters,
                                     const BodyDescription &body,
                                     const TransientObservations &observed)
{
  TransientSummary summary;
  summary.apparent_friction = apparent_friction(parameters, observed);
  evaluate_reference_node(observed, summary);
  evaluate_friction(parameters, body, observed, summary);
  evaluate_energy(observed, summary);
  if (!observed.blocks.empty())
    {
      const std::size_t n_nodes = body.grid.cells[0] + (parameters.periodic ? 0 : 1);
      summary.contact =
        summarize_contact(observed.blocks, n_nodes, observed.dt, observed.steady_from);
      summary.reference_node =
        summary.contact
          .node_shares[std::min<std::size_t>(observed.reference_node, n_nodes - 1)];
      summary.regime = regime_label(summary.reference_node);
    }
  add_remarks(parameters, body, observed, summary);
  return summary;
}
} // namespace mesoslip
