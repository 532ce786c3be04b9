#include "sliding/transient/transient_summary.h"

#include "base/errors.h"
#include "io/json.h"
#include "material/plausibility.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace mesoslip
{
namespace
{
std::optional<double> value_of(const std::optional<Estimate> &estimate,
                               double Estimate::*const part = &Estimate::value)
{
  return estimate ? std::optional<double>((*estimate).*part) : std::nullopt;
}

nlohmann::json shares_json(const ContactShares &shares)
{
  return {
    {"slip", shares.slip}, {"stick", shares.stick}, {"separation", shares.separation}};
}

void log_key_numbers(const TransientObservations &observed,
                     const TransientSummary &summary,
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
      line << ", frictional power over " << summary.load.meaning << " = "
           << summary.load.power << " W/m, from " << summary.mu_inter->begin << " to "
           << summary.mu_inter->end << " s, ";
    }
  if (summary.frequencies)
    line << "main frequency " << summary.frequencies->main.frequency / 1e3 << " kHz, ";
  line << "slip " << 100. * summary.contact.shares.slip << " %, stick "
       << 100. * summary.contact.shares.stick << " %, separated "
       << 100. * summary.contact.shares.separation
       << " %; middle node: " << summary.regime;
  context.log(line.str());
  context.log("Largest strain " + quantity_text(100. * observed.largest_strain, "%"));
}

void log_energy_balance(const TransientObservations &observed,
                        const TransientSummary &summary,
                        const unsigned int energy_interval,
                        RunContext &context)
{
  std::ostringstream text;
  text.precision(3);
  if (summary.energy_residual)
    {
      text << "Energy balance closes to " << *summary.energy_residual << " of "
           << summary.residual_scale;
      // What damping takes between two samples is known only in the mean.
      if (energy_interval > 1 && !(*summary.energy_residual <= 1e-3))
        text << "; it is sampled every " << energy_interval
             << " steps, with Observation/Energy interval = 1 it closes to round-off";
    }
  else if (energy_interval > 0 && observed.energy.time.size() < 2)
    text << "The energy balance is not checked: with Observation/Energy interval = "
         << energy_interval << " the run of " << observed.steps_done
         << " steps has no sample but that of the start";
  else if (energy_interval > 0)
    text << "The energy balance is not checked: there is no energy in it";
  if (!text.str().empty())
    context.log(text.str());
}

/** mu_inter, what it is over, and when. */
void add_friction(const TransientSummary &summary,
                  const TransientRemarks &remarks,
                  nlohmann::json &json)
{
  const auto &mu   = summary.mu_inter;
  const auto &mean = mu ? mu : summary.mean_apparent_friction;
  json["global_interface_friction_coefficient"] = value_of(mu);
  json["global_interface_friction_coefficient_95"] =
    mu && mu->batches > 1 ? value_of(mu, &Estimate::half_width) : std::nullopt;
  json["global_interface_friction_load"] =
    mu ? nlohmann::json(summary.load.power) : nlohmann::json();
  json["global_interface_friction_load_meaning"] =
    text_or_null(mu ? summary.load.meaning : "");
  json["global_interface_friction_warning"]  = text_or_null(remarks.friction);
  json["mean_apparent_friction_coefficient"] = value_of(summary.mean_apparent_friction);
  json["window_begin"]                       = value_of(mean, &Estimate::begin);
  json["window_end"]                         = value_of(mean, &Estimate::end);
}
} // namespace

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

  json["kernel"]                  = observed.kernel;
  json["steps"]                   = observed.steps_done;
  json["time_step"]               = time.step.dt;
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

  const TransientRemarks remarks = remarks_on(parameters, scene, observed, summary);
  add_friction(summary, remarks, json);
  json["slip_fraction"]                    = summary.contact.shares.slip;
  json["stick_fraction"]                   = summary.contact.shares.stick;
  json["separation_fraction"]              = summary.contact.shares.separation;
  json["mean_contact_duration"]            = summary.contact.duration.complete()
                                               ? nlohmann::json(summary.contact.duration.mean)
                                               : nlohmann::json();
  json["mean_contact_duration_node_share"] = summary.contact.duration.node_share;
  json["mean_contact_duration_warning"]    = text_or_null(remarks.duration);
  if (!summary.contact.node_shares.empty())
    json["reference_node"] =
      shares_json(summary.contact.node_shares[summary.reference_node]);
  json["main_frequency"]          = summary.frequencies
                                      ? nlohmann::json(summary.frequencies->main.frequency)
                                      : nlohmann::json();
  json["regime"]                  = summary.regime;
  json["friction_energy"]         = summary.friction_energy;
  json["largest_strain"]          = observed.largest_strain;
  json["energy_balance_residual"] = summary.energy_residual;
  json["energy_balance_scale"] =
    summary.energy_residual ? nlohmann::json(summary.residual_scale) : nlohmann::json();
  json["steady_from"]         = observed.steady_from;
  json["limit_cycle_reached"] = observed.limit_cycle_reached;
  json["limit_cycle"]         = observed.limit_cycle;
  log_key_numbers(observed, summary, context);
  log_energy_balance(observed, summary, parameters.observation.energy_interval, context);
  for (const std::string &text : {remarks.duration, remarks.friction})
    if (!text.empty())
      context.warn(text);
  for (const std::string &text : remarks.others)
    context.warn(text);
}
} // namespace mesoslip
