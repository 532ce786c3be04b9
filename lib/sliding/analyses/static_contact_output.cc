#include "base/errors.h"
#include "dynamics/deformation.h"
#include "io/json.h"
#include "io/table.h"
#include "parameters/parameters.h"
#include "program/run_context.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/analyses/static_support.h"
#include "sliding/body_file.h"
#include "sliding/stated_conditions.h"
#include "sliding/transient/failure_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace mesoslip
{
namespace
{
unsigned int
count(const StaticContactResult &result, const ContactState state, const bool periodic)
{
  const auto &states = result.solution.state;
  return static_cast<unsigned int>(
    std::count(states.begin(), states.end() - (periodic ? 1 : 0), state));
}

/** mu_homo of eq. (17) with the computed pressures and with those of eq. (19). */
struct HomogenizedCoefficients
{
  double static_contact = 0.;
  double repartition    = 0.;
};

HomogenizedCoefficients homogenized(const ContactParameters &parameters,
                                    const Scene &scene,
                                    const StaticContactResult &result)
{
  std::vector<ContactPhase> phases =
    contact_phases(scene.phases, result.surface_fraction);
  if (!parameters.friction.coefficient_by_phase)
    for (ContactPhase &phase : phases)
      phase.friction_coefficient = parameters.friction.coefficient;
  std::vector<double> pressures;
  for (const auto &p : result.phase_pressure)
    if (p)
      pressures.push_back(*p);
  return {homogenized_friction_coefficient(phases, pressures),
          homogenized_friction_coefficient(phases)};
}

void log_result(const ContactParameters &parameters,
                const Scene &scene,
                const StaticContactResult &result,
                const HomogenizedCoefficients &mu,
                RunContext &context)
{
  const StaticContactSolution &s = result.solution;
  std::ostringstream line;
  line.precision(4);
  const unsigned int separated =
    count(result, ContactState::separated, parameters.periodic);
  line << s.state.size() - (parameters.periodic ? 1 : 0) - separated
       << " nodes in contact (" << count(result, ContactState::stick, parameters.periodic)
       << " stick), " << separated << " separated; " << s.iterations << " iterations, "
       << s.solver_iterations << " of the solver";
  context.log(line.str());
  for (std::size_t p = 0; p < scene.phases.size(); ++p)
    {
      char text[200];
      if (result.phase_pressure[p])
        std::snprintf(
          text, sizeof text,
          "  %-12s %6.2f %% of the contact, mean pressure %.4g MPa (eq. 19: %.4g MPa)",
          scene.phases[p].name.c_str(), 100. * result.surface_fraction[p],
          1e-6 * *result.phase_pressure[p], 1e-6 * *result.repartition[p]);
      else
        std::snprintf(text, sizeof text, "  %-12s not in contact",
                      scene.phases[p].name.c_str());
      context.log(text);
    }
  std::ostringstream friction;
  friction.precision(4);
  friction << "Homogenized friction coefficient, eq. (17): " << mu.static_contact
           << " with these pressures, " << mu.repartition << " with those of eq. (19)";
  if (parameters.friction.flat_velocity.amplitude() != 0.)
    friction << "; tangential over normal force, by the coefficients of the nodes: "
             << std::fabs(result.tangential_force / result.normal_force);
  context.log(friction.str());
}

void write_table(const Scene &scene,
                 const StaticContactResult &result,
                 const RunContext &context)
{
  TableWriter table(context.file("static_contact.csv"),
                    {"x [m]", "pressure [Pa]", "shear_traction [Pa]",
                     "friction_coefficient [-]", "displacement_x [m]",
                     "displacement_y [m]", "state"});
  const StaticContactSolution &s = result.solution;
  for (std::size_t i = 0; i < s.state.size(); ++i)
    table.add_row(std::vector<std::string>{
      to_text(i * scene.grid.spacing[0]), to_text(result.node_pressure[i]),
      to_text(result.node_shear[i]), to_text(scene.node_friction[i]),
      to_text(s.displacement.row(0, 0)[i]), to_text(s.displacement.row(1, 0)[i]),
      to_string(s.state[i])});
  table.flush();
}

void write_file(const ContactParameters &parameters,
                const Scene &scene,
                const StaticContactResult &result,
                RunContext &context)
{
  Hdf5File file =
    create_body_file(context.file("dynamics.h5"), "mesoslip-dynamics", scene);
  write_run_conditions(file, stated_conditions(parameters));
  file.write("/snapshots/displacement", snapshot_shape(scene.grid, 1),
             interleaved(result.solution.displacement));
  complete_snapshots(file, {0.});
  std::vector<double> x;
  std::vector<std::uint8_t> state;
  for (std::size_t i = 0; i < result.solution.state.size(); ++i)
    {
      x.push_back(i * scene.grid.spacing[0]);
      state.push_back(static_cast<std::uint8_t>(result.solution.state[i]));
    }
  const std::size_t n = x.size();
  file.write("/static_contact/x", {n}, x);
  file.write("/static_contact/pressure", {n}, result.node_pressure);
  file.write("/static_contact/shear_traction", {n}, result.node_shear);
  file.write("/static_contact/friction_coefficient", {n}, scene.node_friction);
  file.write("/static_contact/state", {n}, state);
  file.write_attribute("/static_contact/state", "meaning",
                       std::vector<std::string>{"separated", "stick", "slip", "held"});
  file.write("/static_contact/cell_pressure", {n - 1}, result.cell_pressure);
  file.write_unit("/static_contact/x", "m");
  file.write_unit("/static_contact/friction_coefficient", "-");
  file.write_unit("/static_contact/state", "-");
  for (const char *name : {"pressure", "shear_traction", "cell_pressure"})
    file.write_unit(std::string("/static_contact/") + name, "Pa");
  file.close();
  write_body_xdmf(context.file("dynamics.xdmf"), scene, "dynamics.h5",
                  {{"displacement", "/snapshots/displacement"}}, {0.});
}

nlohmann::json by_phase(const Scene &scene,
                        const std::vector<std::optional<double>> &values)
{
  nlohmann::json json = nlohmann::json::object();
  for (std::size_t p = 0; p < scene.phases.size(); ++p)
    json[scene.phases[p].name] = values[p];
  return json;
}

void write_summary(const ContactParameters &parameters,
                   const Scene &scene,
                   const StaticContactResult &result,
                   const HomogenizedCoefficients &mu,
                   RunContext &context)
{
  const StaticContactSolution &s   = result.solution;
  nlohmann::json &json             = context.summary();
  json["rve_digest"]               = scene.rve_digest;
  json["pressure"]                 = parameters.top.pressure.amplitude();
  json["flat_velocity"]            = parameters.friction.flat_velocity.amplitude();
  json["friction_coefficient"]     = parameters.friction.coefficient_by_phase
                                       ? nlohmann::json()
                                       : nlohmann::json(parameters.friction.coefficient);
  json["phase_contact_pressures"]  = by_phase(scene, result.phase_pressure);
  json["phase_pressures_eq_19"]    = by_phase(scene, result.repartition);
  json["phase_pressure_imbalance"] = result.pressure_imbalance;
  for (std::size_t p = 0; p < scene.phases.size(); ++p)
    json["surface_fractions"][scene.phases[p].name] = result.surface_fraction[p];
  json["normal_force"]                     = result.normal_force;
  json["tangential_force"]                 = result.tangential_force;
  json["homogenized_friction_coefficient"] = {{"static_contact", mu.static_contact},
                                              {"eq_19", mu.repartition}};
  for (const ContactState state :
       {ContactState::stick, ContactState::slip, ContactState::separated})
    json["nodes"][to_string(state)] = count(result, state, parameters.periodic);
  json["iterations"]        = s.iterations;
  json["state_changes"]     = s.state_changes;
  json["solver_iterations"] = s.solver_iterations;
  json["residual"]          = s.residual;
  json["friction_change"]   = s.friction_change;
}

/** What to do when no equilibrium is found. */
std::string advice(const ContactParameters &parameters, const Scene &scene)
{
  const std::string generic = "loosen Static contact/Tolerance or allow more Iterations";
  const double mu =
    *std::max_element(scene.node_friction.begin(), scene.node_friction.end());
  if (parameters.friction.flat_velocity.amplitude() == 0. || mu <= 0.5)
    return generic;
  return "a sliding body need not have an equilibrium: with a friction coefficient of " +
         to_text(mu) +
         " it may wedge, lift off or tip; reduce Friction/Coefficient or, where the "
         "friction forces hardly change any more, " +
         generic;
}

/** @throws NumericalFailure if a cell is inside out; the largest strain into the summary.
 */
void judge_strain(const ContactParameters &parameters,
                  const UniformMaterial &material,
                  const StaticContactResult &result,
                  RunContext &context)
{
  const NodalField<double> &u = result.solution.displacement;
  const Deformation found =
    largest_deformation(material.grid(), NodeRows::all(u.n_rows()), u, MPI_COMM_SELF);
  const std::string inverted = inverted_cell_text(found, parameters, material);
  if (!inverted.empty())
    throw NumericalFailure("static contact: " + inverted);
  const std::string large = large_strain_warning(found, parameters, material, "");
  if (!large.empty())
    context.warn(large);
  context.summary()["largest_strain"] = found.strain.value;
}
} // namespace

void StaticContactAnalysis::run(RunContext &context)
{
  log_serial_body(context);
  context.remove_results(
    {"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf", "static_contact.csv"});
  StaticContactOptions options;
  options.tolerance        = parameters.static_contact.tolerance;
  options.max_iterations   = parameters.static_contact.max_iterations;
  options.before_iteration = stop_or_report(context, "iteration");

  StaticContactResult result;
  {
    const auto scope = context.timer().scope("Equilibrium");
    with_advice(advice(parameters, scene), [&]() {
      result = compute_static_contact(parameters, scene, material, options,
                                      context.communicator());
    });
  }
  judge_strain(parameters, material, result, context);
  const HomogenizedCoefficients mu = homogenized(parameters, scene, result);
  log_result(parameters, scene, result, mu, context);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Output");
  write_table(scene, result, context);
  write_file(parameters, scene, result, context);
  summarize_body("static contact", context);
  write_summary(parameters, scene, result, mu, context);
}
} // namespace mesoslip
