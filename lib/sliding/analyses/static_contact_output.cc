#include "base/errors.h"
#include "dynamics/deformation.h"
#include "exchange/datasets.h"
#include "exchange/dynamics_file.h"
#include "io/json.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"
#include "program/run_context.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/analyses/static_support.h"
#include "sliding/transient/failure_report.h"

#include <algorithm>
#include <cmath>
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
                                    const BodyDescription &body,
                                    const StaticContactResult &result)
{
  std::vector<ContactPhase> phases = contact_phases(body.phases, result.surface_fraction);
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
                const BodyDescription &body,
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
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    {
      const std::string name = "  " + body.phases[p].name + " ";
      if (!result.phase_pressure[p])
        context.log(name + "not in contact");
      else
        context.log(name + quantity_text(100. * result.surface_fraction[p], "%") +
                    " of the contact, mean pressure " +
                    quantity_text(1e-6 * *result.phase_pressure[p], "MPa") +
                    " (eq. 19: " + quantity_text(1e-6 * *result.repartition[p], "MPa") +
                    ")");
    }
  std::ostringstream friction;
  friction.precision(4);
  friction << "Homogenized friction coefficient, eq. (17): " << mu.static_contact
           << " with these pressures, " << mu.repartition << " with those of eq. (19)";
  if (parameters.contact.flat_velocity.amplitude() != 0.)
    friction << "; tangential over normal force, by the coefficients of the nodes: "
             << std::fabs(result.tangential_force / result.normal_force);
  context.log(friction.str());
}

void write_table(const BodyDescription &body,
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
      to_text(i * body.grid.spacing[0]), to_text(result.node_pressure[i]),
      to_text(result.node_shear[i]), to_text(body.node_friction[i]),
      to_text(s.displacement.row(0, 0)[i]), to_text(s.displacement.row(1, 0)[i]),
      to_string(s.state[i])});
  table.flush();
}

void write_file(const ContactParameters &parameters,
                const BodyDescription &body,
                const StaticContactResult &result,
                const RunContext &context)
{
  DynamicsFile file = DynamicsFile::create(context.file("dynamics.h5"), body);
  write_run_conditions(file, parameters.stated_conditions());
  file.reserve_snapshots(1);
  file.write_snapshot(0, result.solution.displacement);
  file.complete_snapshots({0.});
  std::vector<double> x;
  std::vector<std::uint8_t> state;
  for (const ContactState of_node : result.solution.state)
    {
      x.push_back(static_cast<double>(x.size()) * body.grid.spacing[0]);
      state.push_back(static_cast<std::uint8_t>(of_node));
    }
  const std::string group = "/static_contact";
  write_series(file, group,
               {{"x", "m", &x},
                {"pressure", "Pa", &result.node_pressure},
                {"shear_traction", "Pa", &result.node_shear},
                {"friction_coefficient", "-", &body.node_friction},
                {"cell_pressure", "Pa", &result.cell_pressure}});
  write_dataset(file, group + "/state", {state.size()}, state);
  file.write_attribute(group + "/state", "meaning",
                       std::vector<std::string>{"separated", "stick", "slip", "held"});
  file.close();
}

nlohmann::json by_phase(const BodyDescription &body,
                        const std::vector<std::optional<double>> &values)
{
  nlohmann::json json = nlohmann::json::object();
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    json[body.phases[p].name] = values[p];
  return json;
}

void write_summary(const ContactParameters &parameters,
                   const BodyDescription &body,
                   const StaticContactResult &result,
                   const HomogenizedCoefficients &mu,
                   RunContext &context)
{
  const StaticContactSolution &s = result.solution;
  nlohmann::json &json           = context.summary();
  json.update(
    {{"rve_digest", body.rve_digest},
     {"pressure", parameters.top.pressure.amplitude()},
     {"flat_velocity", parameters.contact.flat_velocity.amplitude()},
     {"friction_coefficient", parameters.friction.coefficient_by_phase
                                ? nlohmann::json()
                                : nlohmann::json(parameters.friction.coefficient)},
     {"phase_contact_pressures", by_phase(body, result.phase_pressure)},
     {"phase_pressures_eq_19", by_phase(body, result.repartition)},
     {"phase_pressure_imbalance", result.pressure_imbalance},
     {"normal_force", result.normal_force},
     {"tangential_force", result.tangential_force},
     {"homogenized_friction_coefficient",
      {{"static_contact", mu.static_contact}, {"eq_19", mu.repartition}}},
     {"iterations", s.iterations},
     {"state_changes", s.state_changes},
     {"solver_iterations", s.solver_iterations},
     {"residual", s.residual},
     {"friction_change", s.friction_change}});
  for (std::size_t p = 0; p < body.phases.size(); ++p)
    json["surface_fractions"][body.phases[p].name] = result.surface_fraction[p];
  for (const ContactState state :
       {ContactState::stick, ContactState::slip, ContactState::separated})
    json["nodes"][to_string(state)] = count(result, state, parameters.periodic);
}

/** What to do when no equilibrium is found. */
std::string advice(const ContactParameters &parameters, const BodyDescription &body)
{
  const std::string generic = "loosen Static contact/Tolerance or allow more Iterations";
  const double mu =
    *std::max_element(body.node_friction.begin(), body.node_friction.end());
  if (parameters.contact.flat_velocity.amplitude() == 0. || mu <= 0.5)
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
  log_body(context);
  context.remove_results(
    {"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf", "static_contact.csv"});
  StaticContactOptions options = parameters.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  StaticContactResult result;
  {
    const auto scope = context.timer().scope("Equilibrium");
    with_advice(advice(parameters, body), [&]() {
      result = compute_static_contact(parameters, body, material, options,
                                      context.communicator());
    });
  }
  judge_strain(parameters, material, result, context);
  const HomogenizedCoefficients mu = homogenized(parameters, body, result);
  log_result(parameters, body, result, mu, context);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Output");
  write_table(body, result, context);
  write_file(parameters, body, result, context);
  summarize_body("static contact", context);
  write_summary(parameters, body, result, mu, context);
}
} // namespace mesoslip
