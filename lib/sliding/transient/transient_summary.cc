#include "sliding/transient/transient_summary.h"

#include "base/errors.h"
#include "io/json.h"
#include "material/plausibility.h"
#include "program/run_context.h"

#include <sstream>

namespace mesoslip
{
namespace
{
using json = nlohmann::json;

/** A member of what may be absent: null without it. */
template <class Part, class Number>
json value_of(const std::optional<Part> &part, Number Part::*const member)
{
  return part ? json((*part).*member) : json();
}

json shares_json(const ContactShares &shares)
{
  return {
    {"slip", shares.slip}, {"stick", shares.stick}, {"separation", shares.separation}};
}

std::string key_numbers(const TransientSummary &summary)
{
  std::ostringstream line;
  line.precision(4);
  if (summary.mu_inter)
    {
      line << "mu_inter = " << summary.mu_inter->value;
      if (summary.mu_inter->batches > 1)
        line << " +- " << summary.mu_inter->half_width << " (95 %)";
      line << ", frictional power over " << summary.load_meaning << " = "
           << summary.load_power << " W/m, from " << summary.mu_inter->begin << " to "
           << summary.mu_inter->end << " s, ";
    }
  if (summary.frequencies)
    line << "main frequency " << summary.frequencies->main_frequency / 1e3 << " kHz, ";
  line << "slip " << 100. * summary.contact.shares.slip << " %, stick "
       << 100. * summary.contact.shares.stick << " %, separated "
       << 100. * summary.contact.shares.separation
       << " %; middle node: " << summary.regime;
  return line.str();
}

std::string energy_balance(const TransientObservations &observed,
                           const TransientSummary &summary,
                           const unsigned int energy_interval)
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
  else if (observed.energy.time.size() < 2)
    text << "The energy balance is not checked: with Observation/Energy interval = "
         << energy_interval << " the run of " << observed.steps_done
         << " steps has no sample but that of the start";
  else
    text << "The energy balance is not checked: there is no energy in it";
  return text.str();
}
} // namespace

void write_summary(const ContactParameters &parameters,
                   const BodyDescription &body,
                   const TimeStepChoice &time,
                   const TransientObservations &observed,
                   const TransientSummary &summary,
                   RunContext &context)
{
  const double n_steps          = static_cast<double>(observed.steps_done),
               n_cells          = static_cast<double>(body.grid.n_cells()),
               seconds          = observed.loop_seconds;
  const FrictionLaw &law        = parameters.contact.law;
  const ContactSummary &contact = summary.contact;
  const auto &mu                = summary.mu_inter;
  const auto &mean              = mu ? mu : summary.mean_apparent_friction;
  const auto null_unless        = [](const bool condition, const auto &value) {
    return condition ? json(value) : json();
  };
  context.summary().update(
    {{"kernel", observed.kernel},
     {"steps", observed.steps_done},
     {"time_step", time.step.dt},
     {"critical_time_step", time.critical},
     {"beta2", time.step.beta2},
     {"rayleigh_beta", time.step.beta},
     {"simulated_time", observed.steps_done * time.step.dt},
     {"cell_updates_per_second", seconds > 0. ? n_steps * n_cells / seconds : 0.},
     {"pressure", parameters.top.pressure.amplitude()},
     {"flat_velocity", parameters.contact.flat_velocity.amplitude()},
     {"regularization_time", null_unless(law.time > 0. && !law.node_law, law.time)},
     {"friction_coefficient", null_unless(!parameters.friction.coefficient_by_phase,
                                          parameters.friction.coefficient)},
     {"global_interface_friction_coefficient", value_of(mu, &Estimate::value)},
     {"global_interface_friction_coefficient_95",
      null_unless(mu && mu->batches > 1, mu.value_or(Estimate()).half_width)},
     {"global_interface_friction_load", null_unless(bool(mu), summary.load_power)},
     {"global_interface_friction_load_meaning",
      null_unless(bool(mu), summary.load_meaning)},
     {"global_interface_friction_warning", text_or_null(summary.friction_warning)},
     {"mean_apparent_friction_coefficient",
      value_of(summary.mean_apparent_friction, &Estimate::value)},
     {"window_begin", value_of(mean, &Estimate::begin)},
     {"window_end", value_of(mean, &Estimate::end)},
     {"slip_fraction", contact.shares.slip},
     {"stick_fraction", contact.shares.stick},
     {"separation_fraction", contact.shares.separation},
     {"mean_contact_duration",
      null_unless(contact.duration.complete(), contact.duration.mean)},
     {"mean_contact_duration_node_share", contact.duration.node_share},
     {"mean_contact_duration_warning", text_or_null(summary.duration_warning)},
     {"main_frequency", value_of(summary.frequencies, &SpectralSummary::main_frequency)},
     {"regime", summary.regime},
     {"friction_energy", summary.friction_energy},
     {"largest_strain", observed.largest_strain},
     {"energy_balance_residual", summary.energy_residual},
     {"energy_balance_scale",
      null_unless(bool(summary.energy_residual), summary.residual_scale)},
     {"steady_from", observed.steady_from},
     {"limit_cycle_reached", observed.limit_cycle_reached},
     {"limit_cycle", observed.limit_cycle}});
  if (!summary.regime.empty())
    context.summary()["reference_node"] = shares_json(summary.reference_node);
  context.log(observed.limit_cycle);
  context.log(key_numbers(summary));
  context.log("Largest strain " + quantity_text(100. * observed.largest_strain, "%"));
  if (parameters.energy_interval > 0)
    context.log(energy_balance(observed, summary, parameters.energy_interval));
  for (const std::string &text : {summary.duration_warning, summary.friction_warning})
    if (!text.empty())
      context.warn(text);
  for (const std::string &text : summary.warnings)
    context.warn(text);
}
} // namespace mesoslip
