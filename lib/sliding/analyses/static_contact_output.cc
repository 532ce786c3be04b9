#include "base/errors.h"
#include "base/exchange.h"
#include "dynamics/stepper.h"
#include "exchange/datasets.h"
#include "exchange/dynamics_file.h"
#include "io/drafts.h"
#include "io/json.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "program/run_context.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/run_plan.h"
#include "sliding/transient/run_draft.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
unsigned int StaticContactAnalysis::count(const ContactState state) const
{
  const auto &states = result.solution.state;
  return static_cast<unsigned int>(
    std::count(states.begin(), states.end() - (parameters.periodic ? 1 : 0), state));
}

void StaticContactAnalysis::log_result(RunContext &context) const
{
  const StaticContactSolution &s = result.solution;
  const unsigned int separated   = count(ContactState::separated);
  context.log(brief_text(4, s.state.size() - (parameters.periodic ? 1 : 0) - separated,
                         " nodes in contact (", count(ContactState::stick), " stick), ",
                         separated, " separated; ", s.iterations, " iterations, ",
                         s.solver_iterations, " of the solver"));
  std::optional<double> sliding;
  if (parameters.contact.flat_velocity.amplitude() != 0.)
    sliding = std::fabs(result.tangential_force / result.normal_force);
  for (const std::string &line : pressure_lines(result.phases, sliding))
    context.log(line);
}

void StaticContactAnalysis::write_table(const RunContext &context) const
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

void StaticContactAnalysis::write_draft(const std::string &folder) const
{
  on_root(MPI_COMM_WORLD, [&]() {
    const DraftMark mark(false);
    DynamicsFile file = DynamicsFile::create(path_of_draft(folder, "dynamics.h5"), body);
    write_static_draft(file, parameters, nodes_shape(body.grid));
    file.close();
  });
}

void StaticContactAnalysis::write_file(const RunContext &context) const
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

void StaticContactAnalysis::write_summary(nlohmann::json &json) const
{
  const StaticContactSolution &s = result.solution;
  const FrictionParameters &mu   = parameters.friction;
  json.update(
    {{"rve_digest", body.rve_digest},
     {"pressure", parameters.top.pressure.amplitude()},
     {"flat_velocity", parameters.contact.flat_velocity.amplitude()},
     {"friction_coefficient",
      mu.coefficient_by_phase ? nlohmann::json() : nlohmann::json(mu.coefficient)},
     {"normal_force", result.normal_force},
     {"tangential_force", result.tangential_force},
     {"iterations", s.iterations},
     {"state_changes", s.state_changes},
     {"solver_iterations", s.solver_iterations},
     {"residual", s.residual},
     {"friction_change", s.friction_change}});
  add_pressures(result.phases, json);
  for (const ContactState state :
       {ContactState::stick, ContactState::slip, ContactState::separated})
    json["nodes"][to_string(state)] = count(state);
}

void StaticContactAnalysis::run(RunContext &context)
{
  log_body(context);
  context.remove_results(
    {"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf", "static_contact.csv"});
  StaticContactOptions options = parameters.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  {
    const auto scope = context.timer().scope("Equilibrium");
    with_advice(equilibrium_advice(body.node_friction,
                                   parameters.contact.flat_velocity.amplitude() != 0.),
                [&]() {
                  result = compute_static_contact(parameters, body, material, options,
                                                  context.communicator());
                });
  }
  const NodalField<double> &u = result.solution.displacement;
  judge_static_strain(
    largest_deformation(body.grid, NodeRows::all(u.n_rows()), u, MPI_COMM_SELF),
    parameters, BodyScales(material), cell_text(body.grid), context);
  log_result(context);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Output");
  write_table(context);
  write_file(context);
  summarize_body("static contact", context);
  write_summary(context.summary());
}
} // namespace mesoslip
