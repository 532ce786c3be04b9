#include "sliding/analyses/friction_homogenization.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "io/json.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
/** Inverts eq. (13), if it has a solution. */
std::optional<double> delta_for(const double mean, const double mu, const double duration)
{
  if (!(mean > 0. && mean < mu))
    return std::nullopt;
  return regularization_time_for(mean, mu, duration);
}

std::optional<double> calibrated_delta(const FrictionHomogenizationInput &input,
                                       const double mu_homo,
                                       const double duration)
{
  if (!input.homogeneous || !input.homogeneous->regularization_time ||
      !if_positive(input.homogeneous->friction_coefficient) ||
      !(input.homogeneous->mu_inter > 0.))
    return std::nullopt;
  const FrictionRun &run = *input.homogeneous;
  const double predicted = mean_friction_coefficient(*run.friction_coefficient,
                                                     *run.regularization_time, duration);
  return delta_for(input.heterogeneous.mu_inter * predicted / run.mu_inter, mu_homo,
                   duration);
}

nlohmann::json run_json(const FrictionRun &run)
{
  nlohmann::json json = {
    {"folder", run.folder},
    {"global_interface_friction_coefficient", run.mu_inter},
    {"mean_contact_duration", run.contact_duration},
    {"mean_contact_duration_warning", text_or_null(run.duration_warning)},
    {"regularization_time", run.regularization_time},
    {"friction_coefficient", run.friction_coefficient}};
  if (run.contact_duration && run.regularization_time &&
      if_positive(run.friction_coefficient))
    json["eq_13"] = mean_friction_coefficient(
      *run.friction_coefficient, *run.regularization_time, *run.contact_duration);
  return json;
}

void write_summary(const FrictionHomogenizationInput &input,
                   const std::vector<FrictionEstimate> &estimates,
                   const double mu_homo,
                   const double delta,
                   const std::string &warning,
                   nlohmann::json &json)
{
  double volume = 0.;
  for (const ContactPhase &phase : input.volume)
    volume += phase.area;
  json.update({{"analysis", "friction homogenization"},
               {"mu_homo", mu_homo},
               {"delta", delta},
               {"delta_warning", text_or_null(warning)},
               {"heterogeneous_run", run_json(input.heterogeneous)},
               {"homogeneous_run",
                input.homogeneous ? run_json(*input.homogeneous) : nlohmann::json()},
               {"volume_fractions_sum", volume}});
  const std::vector<double> repartition = static_pressure_repartition(1., input.surface);
  for (std::size_t p = 0; p < input.surface.size(); ++p)
    json["contact_phases"].push_back(
      {{"name", input.phase_names[p]},
       {"surface_fraction", input.surface[p].area},
       {"youngs_modulus", input.surface[p].youngs_modulus},
       {"friction_coefficient", input.surface[p].friction_coefficient},
       {"relative_pressure_eq_19", repartition[p]},
       {"static_contact_pressure", input.static_pressures.empty()
                                     ? nlohmann::json()
                                     : nlohmann::json(input.static_pressures[p])}});
  for (const FrictionEstimate &e : estimates)
    json["estimates"].push_back({{"pressures", e.pressures},
                                 {"duration_of", e.duration},
                                 {"mu_homo", e.mu_homo},
                                 {"mean_contact_duration", e.contact_duration},
                                 {"delta", e.delta},
                                 {"delta_calibrated", e.calibrated}});
}

void write_table(const std::vector<FrictionEstimate> &estimates, const std::string &path)
{
  TableWriter table(path,
                    {"pressures", "duration_of", "mu_homo [-]",
                     "mean_contact_duration [s]", "delta [s]", "delta_calibrated [s]"});
  const auto cell = [](const std::optional<double> &x) { return x ? to_text(*x) : ""; };
  for (const FrictionEstimate &e : estimates)
    table.add_row(std::vector<std::string>{e.pressures, e.duration, to_text(e.mu_homo),
                                           to_text(e.contact_duration), cell(e.delta),
                                           cell(e.calibrated)});
  table.flush();
}

void log_estimates(const FrictionHomogenizationInput &input,
                   const std::vector<FrictionEstimate> &estimates,
                   RunContext &context)
{
  context.log(brief_text(4,
                         "Heterogeneous run: mu_inter = ", input.heterogeneous.mu_inter,
                         input.homogeneous ? "; homogeneous run: mu_inter = " : "") +
              (input.homogeneous ? quantity_text(input.homogeneous->mu_inter, "") : ""));
  for (const FrictionEstimate &e : estimates)
    context.log(brief_text(
      4, "  pressures by ", e.pressures, ", T_G of the ", e.duration, " run (",
      1e9 * e.contact_duration, " ns): mu_homo = ", e.mu_homo, ", delta = ",
      e.delta ? quantity_text(1e9 * *e.delta, "ns")
              : "none, mu_inter is not between 0 and mu_homo",
      e.calibrated ? " (calibrated: " + quantity_text(1e9 * *e.calibrated, "ns") + ")"
                   : ""));
}
} // namespace

std::vector<FrictionEstimate> friction_estimates(const FrictionHomogenizationInput &input)
{
  std::vector<std::pair<std::string, double>> durations, coefficients;
  if (input.homogeneous && input.homogeneous->contact_duration)
    durations.emplace_back("homogeneous", *input.homogeneous->contact_duration);
  if (input.heterogeneous.contact_duration)
    durations.emplace_back("heterogeneous", *input.heterogeneous.contact_duration);
  if (durations.empty())
    throw UserError(
      "Friction homogenization: no node of " +
      (input.homogeneous ? input.homogeneous->folder + " or " : "") +
      input.heterogeneous.folder +
      " landed and lifted off in the steady part, so T_G of eq. (13) is unknown "
      "(mean_contact_duration is null); use runs in which nodes separate, or longer "
      "ones");
  if (!input.static_pressures.empty())
    coefficients.emplace_back("static contact", input.mu_of_phases());
  coefficients.emplace_back("surface fractions",
                            homogenized_friction_coefficient(input.surface));
  coefficients.emplace_back("volume fractions",
                            homogenized_friction_coefficient(input.volume));
  if (input.static_mu_of_nodes)
    coefficients.emplace_back("nodes in static contact", *input.static_mu_of_nodes);
  coefficients.emplace_back("nodes", input.mu_of_nodes);

  std::vector<FrictionEstimate> estimates;
  for (const auto &[pressures, mu] : coefficients)
    for (const auto &[of, duration] : durations)
      estimates.push_back(
        {pressures, of, mu, duration,
         delta_for(input.heterogeneous.mu_inter, mu, duration),
         of == "homogeneous" ? calibrated_delta(input, mu, duration) : std::nullopt});
  return estimates;
}

std::string node_warning(const FrictionHomogenizationInput &input)
{
  const bool by_statics = input.static_mu_of_nodes.has_value();
  const double phases =
    by_statics ? input.mu_of_phases() : homogenized_friction_coefficient(input.surface);
  const double nodes = by_statics ? *input.static_mu_of_nodes : input.mu_of_nodes;
  if (!(std::fabs(nodes - phases) > 0.02 * phases))
    return "";
  return brief_text(
    4,
    "the contact nodes of the heterogeneous run, with the coefficients that "
    "Friction/Node rule gave them, have mu_homo = ",
    nodes, " instead of ", phases,
    " of the phases, because phases are hardly wider than cells; refine Body/Cells, or "
    "set Pressures from = nodes",
    by_statics ? " in static contact" : "",
    " for a model that is equivalent to that run");
}

std::string duration_warning(const FrictionHomogenizationInput &input,
                             const FrictionEstimate &chosen)
{
  const FrictionRun &run =
    chosen.duration == "homogeneous" ? *input.homogeneous : input.heterogeneous;
  return run.duration_warning.empty()
           ? ""
           : "the proposed delta is poor: in " + run.folder + ", " + run.duration_warning;
}

const FrictionEstimate &
chosen_estimate(const std::vector<FrictionEstimate> &estimates,
                const FrictionHomogenizationParameters &parameters,
                const FrictionHomogenizationInput &input)
{
  // The first estimate uses the static contact analysis, if any, and T_G of the
  // homogeneous run.
  const auto chosen =
    std::find_if(estimates.begin(), estimates.end(), [&](const FrictionEstimate &e) {
      return parameters.pressures == "auto" || parameters.pressures == e.pressures;
    });
  if (chosen == estimates.end())
    throw UserError(
      "Friction homogenization/Pressures from is " + parameters.pressures +
      (parameters.static_contact.empty()
         ? ", but Static contact is empty; name the folder of such an analysis"
         : ", but the Static contact has other contact nodes than the "
           "heterogeneous run; run both on the same cells"));
  if (parameters.calibrate && !chosen->calibrated)
    throw UserError(
      "Friction homogenization/Calibrate is true, but that needs a Homogeneous run with "
      "one positive coefficient, a constant regularization time, known T_G, and a "
      "calibrated mu_inter below " +
      to_text(chosen->mu_homo));
  if (!parameters.calibrate && !chosen->delta)
    throw UserError(
      "Friction homogenization: mu_inter = " + to_text(input.heterogeneous.mu_inter) +
      " of " + input.heterogeneous.folder +
      (input.heterogeneous.mu_inter > 0.
         ? " is not below mu_homo = " + to_text(chosen->mu_homo)
         : std::string(" is not positive")) +
      ", so eq. (13) has no regularization time; check that the run slid steadily or "
      "choose other Pressures from");
  return *chosen;
}

FrictionHomogenizationAnalysis::FrictionHomogenizationAnalysis(const ContactParameters &p)
  : parameters(p.homogenization)
{
  on_root(MPI_COMM_WORLD, [&]() {
    input     = read_friction_homogenization(parameters);
    estimates = friction_estimates(input);
  });
}

void FrictionHomogenizationAnalysis::run(RunContext &context)
{
  context.remove_results({"friction_homogenization.csv"});
  on_root(context.communicator(), [&]() {
    for (const std::string &warning : input.warnings)
      context.warn(warning);
    log_estimates(input, estimates, context);
    if (const std::string of_nodes = node_warning(input); !of_nodes.empty())
      context.warn(of_nodes);
    write_table(estimates, context.file("friction_homogenization.csv"));

    const FrictionEstimate &chosen = chosen_estimate(estimates, parameters, input);
    const double delta = *(parameters.calibrate ? chosen.calibrated : chosen.delta);
    const std::string warning = duration_warning(input, chosen);
    if (!warning.empty())
      context.warn(warning);
    context.log("For the .prm of the homogeneous model:");
    context.log(
      "subsection Friction\n  set Coefficient         = " + to_text(chosen.mu_homo) +
      "\n  set Regularization time = " + to_text(delta) + "\nend");
    write_summary(input, estimates, chosen.mu_homo, delta, warning, context.summary());
  });
}
} // namespace mesoslip
