#include "sliding/transient/transient_setup.h"
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

std::vector<ContactBlock>
to_blocks(const std::vector<NodeCounts> &counts, const double dt, const bool periodic)
{
  std::vector<ContactBlock> blocks;
  for (const NodeCounts &count : counts)
    {
      ContactBlock block;
      block.begin         = count.first_step * dt;
      block.end           = (count.first_step + count.n_steps) * dt;
      block.steps         = count.n_steps;
      const auto distinct = [&](const std::vector<float> &values) {
        return std::vector<double>(values.begin(), values.end() - (periodic ? 1 : 0));
      };
      block.stick    = distinct(count.stick);
      block.slip     = distinct(count.slip);
      block.landings = distinct(count.landings);
      blocks.push_back(block);
    }
  return blocks;
}

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
  summary.n_steady             = ux.size();
  if (summary.n_steady < TransientSummary::least_samples)
    return;

  summary.spectrum     = amplitude_spectrum(ux, series.interval);
  summary.hidden_share = hidden_share(ux, tail(series.displacement_variance, first));
  summary.folded_share = share_near_limit(summary.spectrum);
  // Beyond it what the means leave of a fast motion could pass for a slow one.
  if (summary.hidden_share <= 0.5)
    summary.frequencies =
      summarize_spectrum(summary.spectrum, FrequencyBand(), 0.1, 1e-15);
  const auto cut = std::upper_bound(summary.spectrum.frequency.begin(),
                                    summary.spectrum.frequency.end(), spectrum_cut) -
                   summary.spectrum.frequency.begin();
  summary.spectrum.frequency.resize(cut);
  summary.spectrum.amplitude.resize(cut);
  summary.phase_diagram = mean_phase_diagram(
    ux, vx, series.interval,
    summary.frequencies ? 1. / summary.frequencies->main.frequency : 0.);
}

/**
 * P S |V| (W/m) while a constant pressure is all that presses on the flat, which moves at
 * a constant velocity; otherwise 0.
 */
double nominal_load(const ContactParameters &parameters,
                    const Scene &scene,
                    const double begin,
                    const double end)
{
  const LoadHistory &pressure = parameters.top.pressure,
                    &velocity = parameters.friction.flat_velocity;
  const bool pressed          = parameters.top.kind != TopSetup::Kind::held &&
                       parameters.top.hold_from > end &&
                       parameters.body.acceleration[1] == 0.;
  return pressed && pressure.is_constant_from(begin) && velocity.is_constant_from(begin)
           ? pressure(begin) * scene.grid.extent(0) * std::fabs(velocity(begin))
           : 0.;
}

/** What mu_inter is over: the work of the nominal load, or of the forces that acted. */
std::vector<double> evaluate_load(const ContactParameters &parameters,
                                  const Scene &scene,
                                  const SteadySeries &series,
                                  const MeanWindow &window,
                                  TransientSummary &summary)
{
  const Estimate acted = mean_power(series.time, series.load_work, window);
  const double nominal = nominal_load(parameters, scene, acted.begin, acted.end);
  summary.load         = {acted.value, "the mean of F_N |V|"};
  if (!(std::fabs(acted.value - nominal) <= nominal_tolerance * nominal))
    return series.load_work;
  summary.load             = {nominal, "P S |V|"};
  std::vector<double> work = series.time;
  for (double &value : work)
    value *= nominal;
  return work;
}

void evaluate_friction(const ContactParameters &parameters,
                       const Scene &scene,
                       const TransientObservations &observed,
                       TransientSummary &summary)
{
  const SteadySeries &series = observed.series;
  if (!summary.has_statistics(observed))
    return;
  const MeanWindow window = {
    observed.steady_from, series.time.back(),
    summary.frequencies ? 1. / summary.frequencies->main.frequency : 0.};
  const std::vector<double> load_work =
    evaluate_load(parameters, scene, series, window, summary);
  if (summary.load.power > 0. && std::isfinite(summary.load.power))
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
  const auto consider = [&](const double term, const char *name) {
    if (friction < 0.1 * term && scale.first < term)
      scale = {term, name};
  };
  std::vector<double> energy = e.kinetic;
  for (std::size_t k = 0; k < energy.size(); ++k)
    energy[k] += e.elastic[k];
  consider(largest(energy), "the energy in the body");
  consider(largest(e.potential), "the work of the body forces");
  consider(largest(e.external_work), "the work of the loads");
  consider(largest(e.impact), "the impact energy");
  consider(largest(e.damping), "the damped energy");
  consider(largest(e.scheme), "the energy that the scheme dissipates");
  summary.residual_scale = scale.second;
  if (scale.first > 0.)
    summary.energy_residual = largest(e.residual()) / scale.first;
}
} // namespace

bool TransientSummary::has_statistics(const TransientObservations &observed) const
{
  return observed.series.time.size() >= least_samples && n_steady >= 3;
}

TransientSummary summarize_transient(const ContactParameters &parameters,
                                     const Scene &scene,
                                     const TransientObservations &observed)
{
  TransientSummary summary;
  summary.apparent_friction = apparent_friction(parameters, observed);
  evaluate_reference_node(observed, summary);
  evaluate_friction(parameters, scene, observed, summary);
  evaluate_energy(observed, summary);

  const auto blocks = to_blocks(observed.blocks, observed.dt, parameters.periodic);
  if (!blocks.empty())
    {
      summary.contact =
        summarize_contact(blocks, observed.steady_from, blocks.back().end);
      summary.reference_node = std::min<std::size_t>(
        observed.reference_node, summary.contact.node_shares.size() - 1);
      summary.regime = regime_label(summary.contact.node_shares[summary.reference_node]);
    }
  return summary;
}
} // namespace mesoslip
