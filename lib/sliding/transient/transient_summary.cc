#include "base/text.h"
#include "io/json.h"
#include "material/plausibility.h"
#include "program/run_context.h"
#include "sliding/supports/support_text.h"
#include "sliding/transient/transient_result.h"

namespace mesoslip
{
namespace
{
using json = nlohmann::json;

/** A member of an optional result; null if it is absent. */
template <class Part, class Number>
json value_of(const std::optional<Part> &part, Number Part::*const member)
{
  return part ? json((*part).*member) : json();
}

template <class Value>
json null_unless(const bool condition, const Value &value)
{
  return condition ? json(value) : json();
}

/** Kind, constrained components, loads and springs of the top and of each side that has
 * any. */
json supports_json(const ContactParameters &parameters)
{
  const unsigned int dim = parameters.mesh.mesh.dim;
  json all;
  std::vector<const SideSupport *> sides = {&parameters.top};
  for (const SideSupport &side : parameters.supports)
    sides.push_back(&side);
  for (const SideSupport *side : sides)
    {
      const Suspension &on = side->suspension;
      json held            = json::array();
      for (unsigned int c = 0; c < dim; ++c)
        if (side->held[c])
          held.push_back(std::string("u_") + "xyz"[c]);
      all[side->name] = {{"kind", kind_of(*side, dim)},
                         {"held", held},
                         {"loads", support_text(*side, dim)},
                         {"pressure", null_unless(!side->pressure.is_expression(),
                                                  side->pressure.amplitude())},
                         {"spring_stiffness", on.stiffness},
                         {"dashpot", on.dashpot},
                         {"mass", on.mass},
                         {"platen_mass", side->platen_mass},
                         {"absorbing", on.absorbing}};
    }
  return all;
}

std::string key_numbers(const TransientResult &run)
{
  std::string text;
  if (run.mu_inter)
    text = brief_text(4, "mu_inter = ", run.mu_inter->value,
                      run.mu_inter->batches > 1
                        ? brief_text(4, " +- ", run.mu_inter->half_width, " (95 %)")
                        : "",
                      ", frictional power over ", run.load_meaning, " = ", run.load_power,
                      run.body.unit(" W"), ", from ", run.mu_inter->begin, " to ",
                      run.mu_inter->end, " s, ");
  if (run.frequencies)
    text +=
      brief_text(4, "main frequency ", run.frequencies->main_frequency / 1e3, " kHz, ");
  const ContactShares &shares = run.contact.shares;
  return brief_text(4, text, "slip ", 100. * shares.slip, " %, stick ",
                    100. * shares.stick, " %, separated ", 100. * shares.separation,
                    " %; reference node: ", run.regime);
}

std::string energy_balance(const TransientResult &run)
{
  const unsigned int interval = run.parameters.energy_interval;
  if (run.energy_residual)
    // Dissipation by damping between two samples is known only on average.
    return brief_text(3, "Energy balance closes to ", *run.energy_residual, " of ",
                      run.residual_scale) +
           (interval > 1 && !(*run.energy_residual <= 1e-3)
              ? brief_text(3, "; it is sampled every ", interval,
                           " steps, with Observation/Energy interval = 1 it closes to "
                           "round-off")
              : "");
  const std::string unchecked = "The energy balance is not checked: ";
  return run.energy.time.size() < 2
           ? brief_text(3, unchecked, "with Observation/Energy interval = ", interval,
                        " the run of ", run.steps_done,
                        " steps has no sample but that of the start")
           : unchecked + "there is no energy in it";
}
} // namespace

void TransientResult::write_summary(RunContext &context) const
{
  const double n_steps   = static_cast<double>(steps_done),
               n_cells   = static_cast<double>(body.n_cells);
  const FrictionLaw &law = parameters.contact.law;
  const auto &mean       = mu_inter ? mu_inter : mean_apparent_friction;
  json &summary          = context.summary();
  summary.update(
    {{"kernel", kernel},
     {"steps", steps_done},
     {"time_step", time.step.dt},
     {"critical_time_step", time.critical},
     {"beta2", time.step.beta2},
     {"rayleigh_beta", time.step.beta},
     {"rayleigh_alpha", time.step.alpha},
     {"normal_stiffness", null_unless(parameters.contact.is_compliant(),
                                      parameters.contact.normal_spring.stiffness)},
     {"normal_exponent", null_unless(parameters.contact.is_compliant(),
                                     parameters.contact.normal_spring.exponent)},
     {"tangential_stiffness", null_unless(parameters.contact.slips_on_springs(),
                                          parameters.contact.tangential_stiffness)},
     {"flat_profile",
      parameters.contact.profile ? json(parameters.contact.profile->text()) : json()},
     {"simulated_time", steps_done * time.step.dt},
     {"cell_updates_per_second",
      loop_seconds > 0. ? n_steps * n_cells / loop_seconds : 0.},
     {"pressure", parameters.top.pressure.amplitude()},
     {"flat_velocity", parameters.contact.flat_velocity.amplitude()},
     {"regularization_time", null_unless(law.time > 0. && !law.node_law, law.time)},
     {"friction_coefficient", null_unless(parameters.friction.has_constant_coefficient(),
                                          parameters.friction.coefficient)},
     {"coefficient_law",
      null_unless(bool(law.coefficient_law), parameters.friction.coefficient_law.text())},
     {"largest_weakening",
      null_unless(law.coefficient_law && law.coefficient_law->knows_falls(),
                  largest_weakening)},
     {"contact_trials_per_step",
      null_unless(settling.trials > 0, static_cast<double>(settling.trials) / n_steps)},
     {"contact_unsettled_steps",
      null_unless(settling.trials > 0, static_cast<double>(settling.unsettled))},
     {"global_interface_friction_coefficient", value_of(mu_inter, &Estimate::value)},
     {"global_interface_friction_coefficient_95",
      null_unless(mu_inter && mu_inter->batches > 1,
                  mu_inter.value_or(Estimate()).half_width)},
     {"global_interface_friction_load", null_unless(bool(mu_inter), load_power)},
     {"global_interface_friction_load_meaning",
      null_unless(bool(mu_inter), load_meaning)},
     {"global_interface_friction_warning", text_or_null(friction_warning)},
     {"mean_apparent_friction_coefficient",
      value_of(mean_apparent_friction, &Estimate::value)},
     {"window_begin", value_of(mean, &Estimate::begin)},
     {"window_end", value_of(mean, &Estimate::end)},
     {"slip_fraction", contact.shares.slip},
     {"stick_fraction", contact.shares.stick},
     {"separation_fraction", contact.shares.separation},
     {"mean_contact_duration",
      null_unless(contact.duration.complete(), contact.duration.mean)},
     {"mean_contact_duration_node_share", contact.duration.node_share},
     {"mean_contact_duration_warning", text_or_null(duration_warning)},
     {"main_frequency", value_of(frequencies, &SpectralSummary::main_frequency)},
     {"reference_velocity_amplitude", velocity_amplitude},
     {"regime", regime},
     {"friction_energy", friction_energy},
     {"largest_strain", largest_strain()},
     {"single_precision_rounding",
      null_unless(parameters.sweep.single_precision, rounded_share())},
     {"energy_balance_residual", energy_residual},
     {"energy_balance_scale", null_unless(bool(energy_residual), residual_scale)},
     {"steady_from", steady_from},
     {"limit_cycle_reached", limit_cycle_reached},
     {"limit_cycle", limit_cycle}});
  if (!time.step.beta_of_phases.empty())
    summary["rayleigh_beta_of_phases"] = time.step.beta_of_phases;
  if (!time.step.alpha_of_phases.empty())
    summary["rayleigh_alpha_of_phases"] = time.step.alpha_of_phases;
  summary["supports"] = supports_json(parameters);
  if (body.dim == 3)
    summary["flat_direction"] = parameters.contact.flat_direction;
  if (!regime.empty())
    summary["reference_node"] = {{"slip", reference_shares.slip},
                                 {"stick", reference_shares.stick},
                                 {"separation", reference_shares.separation}};
  context.log(limit_cycle);
  context.log(key_numbers(*this));
  context.log("Largest strain " + quantity_text(100. * largest_strain(), "%") +
              (parameters.sweep.single_precision
                 ? "; single precision rounds strains by up to " +
                     quantity_text(100. * rounded_share(), "%") + " of it"
                 : ""));
  if (parameters.energy_interval > 0)
    context.log(energy_balance(*this));
  if (!duration_warning.empty()) // friction homogenization, which uses T_G, warns
    context.log(duration_warning);
  if (!friction_warning.empty())
    context.warn(friction_warning);
  for (const std::string &text : warnings)
    context.warn(text);
}
} // namespace mesoslip
