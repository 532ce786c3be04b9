#include "simulation/transient_summary.h"

#include "io/errors.h"
#include "io/run_context.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

namespace mesoslip
{
namespace
{
constexpr double spectrum_cut = 1e6; // Hz

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
  const bool transmits =
    parameters.top.kind != TopSetup::Kind::pressure || parameters.top.lateral_held;
  const auto &tangential =
    transmits ? observed.top.tangential_force : observed.contact.tangential_force;
  const auto &normal =
    transmits ? observed.top.normal_force : observed.contact.normal_force;
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

std::ptrdiff_t n_steady_samples(const TransientObservations &observed)
{
  const std::vector<double> &time = observed.contact.time;
  return time.end() - std::lower_bound(time.begin(), time.end(), observed.steady_from);
}

void evaluate_reference_node(const TransientObservations &observed,
                             TransientSummary &summary)
{
  const ContactHistory &h = observed.contact;
  if (h.time.size() < 16)
    return;
  const double sampling        = h.time[1] - h.time[0];
  const std::size_t first      = h.time.size() - n_steady_samples(observed);
  const std::vector<double> ux = tail(h.nodes[0].ux, first),
                            vx = tail(h.nodes[0].vx, first);
  if (ux.size() < 16)
    return;

  summary.spectrum    = amplitude_spectrum(ux, sampling);
  summary.frequencies = summarize_spectrum(summary.spectrum, FrequencyBand(), 0.1, 1e-15);
  const auto cut      = std::upper_bound(summary.spectrum.frequency.begin(),
                                         summary.spectrum.frequency.end(), spectrum_cut) -
                   summary.spectrum.frequency.begin();
  summary.spectrum.frequency.resize(cut);
  summary.spectrum.amplitude.resize(cut);
  summary.phase_diagram = mean_phase_diagram(
    ux, vx, sampling,
    summary.frequencies ? 1. / summary.frequencies->main.frequency : 0.);
}

void evaluate_friction(const ContactParameters &parameters,
                       const Scene &scene,
                       const TransientObservations &observed,
                       TransientSummary &summary)
{
  const ContactHistory &h = observed.contact;
  if (h.time.size() < 16 || n_steady_samples(observed) < 3)
    return;
  const double reference_power = parameters.top.pressure.amplitude() *
                                 scene.grid.extent(0) *
                                 std::fabs(parameters.friction.flat_velocity.amplitude());
  const double period =
    summary.frequencies ? 1. / summary.frequencies->main.frequency : 0.;
  const double end = h.time.back();
  if (reference_power > 0.)
    summary.mu_inter = interface_friction_coefficient(
      h.time, h.friction_energy, observed.steady_from, end, period, reference_power);
  if (std::any_of(summary.apparent_friction.begin(), summary.apparent_friction.end(),
                  [](const double x) { return x != 0.; }))
    summary.mean_apparent_friction =
      window_mean(h.time, summary.apparent_friction, observed.steady_from, end, period);
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
  if (e.time.empty())
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

nlohmann::json value_or_null(const std::optional<Estimate> &estimate)
{
  return estimate ? nlohmann::json(estimate->value) : nlohmann::json();
}

/** Begin or end of the window that the means are of. */
nlohmann::json window_json(const TransientSummary &summary, double Estimate::*const limit)
{
  const auto &mean = summary.mu_inter ? summary.mu_inter : summary.mean_apparent_friction;
  return mean ? nlohmann::json((*mean).*limit) : nlohmann::json();
}

nlohmann::json shares_json(const ContactShares &shares)
{
  return {
    {"slip", shares.slip}, {"stick", shares.stick}, {"separation", shares.separation}};
}

/** A run that ended before Steady from, at a limit cycle or on request. */
std::string steady_part_warning(const TransientObservations &observed)
{
  if (observed.contact.time.size() < 16 || n_steady_samples(observed) >= 3)
    return "";
  std::ostringstream text;
  text
    << "fewer than three samples lie between the start of the steady part, "
    << observed.steady_from << " s, and the end, " << observed.contact.time.back()
    << " s: mu_inter and the spectrum are left out; set Observation/Steady from earlier";
  return text.str();
}

/** What to say about T_G; empty when it can be relied on. */
std::string contact_duration_warning(const ContactDuration &duration)
{
  if (!duration.complete() || duration.representative())
    return "";
  std::ostringstream text;
  text.precision(3);
  text << "T_G = " << duration.mean << " s rests on the " << 100. * duration.node_share
       << " % of the contact nodes that landed in the steady part; the others never left "
          "the flat "
          "and only add time, so T_G grows with the run and eq. (13) should not be used "
          "with it";
  return text.str();
}

void log_key_numbers(const TransientObservations &observed,
                     const TransientSummary &summary,
                     const unsigned int energy_interval,
                     RunContext &context)
{
  context.log(observed.limit_cycle);
  std::ostringstream line;
  line.precision(4);
  if (summary.mu_inter)
    {
      line << "mu_inter = " << summary.mu_inter->value;
      if (summary.mu_inter->batches > 1)
        line << " +- " << summary.mu_inter->half_width << " (95 %)";
      line << " from " << summary.mu_inter->begin << " to " << summary.mu_inter->end
           << " s, ";
    }
  if (summary.frequencies)
    line << "main frequency " << summary.frequencies->main.frequency / 1e3 << " kHz, ";
  line << "slip " << 100. * summary.contact.shares.slip << " %, stick "
       << 100. * summary.contact.shares.stick << " %, separated "
       << 100. * summary.contact.shares.separation
       << " %; middle node: " << summary.regime;
  context.log(line.str());
  context.log("Largest strain " + quantity_text(100. * observed.largest_strain, "%"));
  if (summary.energy_residual)
    {
      std::ostringstream energy;
      energy.precision(3);
      energy << "Energy balance closes to " << *summary.energy_residual << " of "
             << summary.residual_scale;
      // What damping takes between two samples is known only in the mean.
      if (energy_interval > 1 && !(*summary.energy_residual <= 1e-3))
        energy << "; it is sampled every " << energy_interval
               << " steps, with Observation/Energy interval = 1 it closes to round-off";
      context.log(energy.str());
    }
}
} // namespace

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

void write_summary(const ContactParameters &parameters,
                   const Scene &scene,
                   const TimeStepChoice &time,
                   const TransientObservations &observed,
                   const TransientSummary &summary,
                   RunContext &context)
{
  const double simulated = observed.steps_done * time.step.dt;
  const double speed     = observed.loop_seconds > 0.
                             ? observed.steps_done *
                             static_cast<double>(scene.grid.n_cells()) /
                             observed.loop_seconds
                             : 0.;
  nlohmann::json &json   = context.summary();

  json["dim"]       = 2;
  json["cells"]     = scene.grid.n_cells();
  json["dofs"]      = 2 * scene.grid.n_nodes();
  json["analysis"]  = "transient";
  json["material"]  = parameters.body.heterogeneous ? "heterogeneous" : "homogeneous";
  json["kernel"]    = observed.kernel;
  json["steps"]     = observed.steps_done;
  json["time_step"] = time.step.dt;
  json["critical_time_step"]      = time.critical;
  json["beta2"]                   = time.step.beta2;
  json["rayleigh_beta"]           = time.step.beta;
  json["simulated_time"]          = simulated;
  json["cell_updates_per_second"] = speed;
  json["pressure"]                = parameters.top.pressure.amplitude();
  json["flat_velocity"]           = parameters.friction.flat_velocity.amplitude();

  const FrictionLaw &law = parameters.friction.law;
  json["regularization_time"] =
    law.time > 0. && !law.node_law ? nlohmann::json(law.time) : nlohmann::json();
  json["friction_coefficient"] = parameters.friction.coefficient_by_phase
                                   ? nlohmann::json()
                                   : nlohmann::json(parameters.friction.coefficient);

  json["global_interface_friction_coefficient"] = value_or_null(summary.mu_inter);
  json["global_interface_friction_coefficient_95"] =
    summary.mu_inter && summary.mu_inter->batches > 1
      ? nlohmann::json(summary.mu_inter->half_width)
      : nlohmann::json();
  json["mean_apparent_friction_coefficient"] =
    value_or_null(summary.mean_apparent_friction);
  json["slip_fraction"]                    = summary.contact.shares.slip;
  json["stick_fraction"]                   = summary.contact.shares.stick;
  json["separation_fraction"]              = summary.contact.shares.separation;
  json["mean_contact_duration"]            = summary.contact.duration.complete()
                                               ? nlohmann::json(summary.contact.duration.mean)
                                               : nlohmann::json();
  json["mean_contact_duration_node_share"] = summary.contact.duration.node_share;
  const std::string warning = contact_duration_warning(summary.contact.duration);
  json["mean_contact_duration_warning"] =
    warning.empty() ? nlohmann::json() : nlohmann::json(warning);
  if (!summary.contact.node_shares.empty())
    json["reference_node"] =
      shares_json(summary.contact.node_shares[summary.reference_node]);
  json["main_frequency"]  = summary.frequencies
                              ? nlohmann::json(summary.frequencies->main.frequency)
                              : nlohmann::json();
  json["regime"]          = summary.regime;
  json["friction_energy"] = summary.friction_energy;
  json["largest_strain"]  = observed.largest_strain;
  json["energy_balance_residual"] =
    summary.energy_residual ? nlohmann::json(*summary.energy_residual) : nlohmann::json();
  json["energy_balance_scale"] =
    summary.energy_residual ? nlohmann::json(summary.residual_scale) : nlohmann::json();
  json["steady_from"]         = observed.steady_from;
  json["window_begin"]        = window_json(summary, &Estimate::begin);
  json["window_end"]          = window_json(summary, &Estimate::end);
  json["limit_cycle_reached"] = observed.limit_cycle_reached;
  json["limit_cycle"]         = observed.limit_cycle;
  log_key_numbers(observed, summary, parameters.observation.energy_interval, context);
  for (const std::string &text : {warning, steady_part_warning(observed)})
    if (!text.empty())
      context.warn(text);
}
} // namespace mesoslip
