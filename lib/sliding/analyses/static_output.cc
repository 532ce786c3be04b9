#include "base/errors.h"
#include "base/exchange.h"
#include "body/elastic_body.h"
#include "exchange/datasets.h"
#include "exchange/grid_file.h"
#include "io/drafts.h"
#include "io/json.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "program/run_context.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/transient/run_draft.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mesoslip
{
namespace
{
/** Name of component @p c along the flat; x has no suffix. */
std::string along_flat(const std::string &name, const std::size_t c)
{
  return c == 0 ? name : name + "_y";
}

} // namespace

template <int dim>
StaticContactAnalysis<dim>::StaticContactAnalysis(std::unique_ptr<GivenBody<dim>> given)
  : BodyAnalysis<dim>(std::move(given))
{
  check_static_load(parameters, facts);
}

template <int dim>
void StaticContactAnalysis<dim>::write_draft(const std::string &folder) const
{
  on_root(MPI_COMM_WORLD, [&]() {
    const DraftMark mark(false);
    Hdf5File file =
      body->create_file(path_of_draft(folder, "dynamics.h5"), dynamics_format);
    write_static_draft(file, parameters, body->vectors_shape());
    file.close();
    if (const GivenBody<dim> *lower = body->lower())
      {
        Hdf5File below =
          lower->create_file(path_of_draft(folder, "counter_body.h5"), dynamics_format);
        write_static_draft(below, parameters, lower->vectors_shape(), true);
        below.close();
      }
  });
}

template <int dim>
std::size_t StaticContactAnalysis<dim>::count(const ContactState state) const
{
  const auto first = result.solution.state.begin();
  return static_cast<std::size_t>(std::count(
    first, first + static_cast<std::ptrdiff_t>(facts.size.n_contact_nodes), state));
}

/** Friction along the motion of the flat over the normal force; empty if the flat is at
 * rest. */
template <int dim>
std::optional<double> StaticContactAnalysis<dim>::sliding_friction() const
{
  const ContactSetup &flat = parameters.contact;
  if (flat.flat_velocity.amplitude() == 0.)
    return std::nullopt;
  double along = 0.;
  for (unsigned int c = 0; c + 1 < dim; ++c)
    along += flat.flat_direction[c] * result.tangential_force[c];
  return std::fabs(along) / result.normal_force;
}

template <int dim>
void StaticContactAnalysis<dim>::log_result(RunContext &context) const
{
  const StaticContactSolution &s = result.solution;
  const std::size_t separated    = count(ContactState::separated);
  context.log(brief_text(4, facts.size.n_contact_nodes - separated, " nodes in contact (",
                         count(ContactState::stick), " stick), ", separated,
                         " separated; ", s.iterations, " iterations, ",
                         s.solver_iterations, " of the solver"));
  for (const std::string &line : pressure_lines(result.phases, sliding_friction()))
    context.log(line);
}

template <int dim>
void StaticContactAnalysis<dim>::write_contact_table(
  const RunContext &context, const std::vector<double> &displaced) const
{
  const std::vector<std::vector<double>> places = body->contact_places();
  std::vector<std::string> columns;
  const auto add = [&](const std::string &name, const std::size_t n, const char *unit) {
    for (std::size_t c = 0; c < n; ++c)
      columns.push_back(name + "xyz"[c] + unit);
  };
  add("", places.size(), " [m]");
  columns.emplace_back("pressure [Pa]");
  for (unsigned int c = 0; c + 1 < dim; ++c)
    columns.push_back(along_flat("shear_traction", c) + " [Pa]");
  columns.emplace_back("friction_coefficient [-]");
  add("displacement_", dim, " [m]");
  columns.emplace_back("state");
  TableWriter table(context.file("static_contact.csv"), columns);
  for (std::size_t i = 0; i < result.node_pressure.size(); ++i)
    {
      std::vector<std::string> row;
      for (const std::vector<double> &coordinate : places)
        row.push_back(to_text(coordinate[i]));
      row.push_back(to_text(result.node_pressure[i]));
      for (const std::vector<double> &component : result.node_shear)
        row.push_back(to_text(component[i]));
      row.push_back(to_text(facts.size.friction[i]));
      for (unsigned int c = 0; c < dim; ++c)
        row.push_back(to_text(displaced[dim * i + c]));
      row.push_back(to_string(result.solution.state[i]));
      table.add_row(row);
    }
  table.flush();
}

template <int dim>
void StaticContactAnalysis<dim>::write_step_table(const RunContext &context) const
{
  const std::string force          = dim == 2 ? " [N/m]" : " [N]",
                    area           = dim == 2 ? " [m]" : " [m^2]";
  std::vector<std::string> columns = {"share_of_load [-]"};
  for (unsigned int c = 0; c + 1 < dim; ++c)
    columns.push_back(std::string("flat_displacement_") + "xy"[c] + " [m]");
  columns.push_back("normal_force" + force);
  for (unsigned int c = 0; c + 1 < dim; ++c)
    columns.push_back(along_flat("tangential_force", c) + force);
  columns.insert(columns.end(),
                 {"contact_area" + area, "stick_area" + area, "iterations [-]"});
  TableWriter table(context.file("load_steps.csv"), columns);
  for (const StaticLoadStep &step : result.steps)
    {
      std::vector<double> row = {step.share};
      const auto add          = [&row](const std::array<double, 2> &vector) {
        row.insert(row.end(), vector.begin(), vector.begin() + (dim - 1));
      };
      add(step.displacement);
      row.push_back(step.normal_force);
      add(step.tangential_force);
      row.insert(row.end(), {step.contact_area, step.stick_area,
                             static_cast<double>(step.iterations)});
      table.add_row(row);
    }
  table.flush();
}

template <int dim>
void StaticContactAnalysis<dim>::write_contact_group(Hdf5File &file) const
{
  const std::string group                       = "/static_contact";
  const std::vector<std::vector<double>> places = body->contact_places();
  std::vector<Series> series = {{"pressure", "Pa", &result.node_pressure},
                                {"friction_coefficient", "-", &facts.size.friction},
                                {"area", dim == 2 ? "m" : "m^2", &facts.size.area}};
  for (std::size_t c = 0; c < places.size(); ++c)
    series.push_back({std::string(1, "xyz"[c]), "m", &places[c]});
  for (unsigned int c = 0; c + 1 < dim; ++c)
    series.push_back({along_flat("shear_traction", c), "Pa", &result.node_shear[c]});
  if (facts.contact_points.empty())
    series.push_back({"cell_pressure", "Pa", &result.cell_pressure});
  else
    write_dataset(file, group + "/point", {facts.contact_points.size()},
                  facts.contact_points);
  write_series(file, group, series);
  std::vector<std::uint8_t> state;
  for (const ContactState of_node : result.solution.state)
    state.push_back(static_cast<std::uint8_t>(of_node));
  write_dataset(file, group + "/state", {state.size()}, state);
  file.write_attribute(group + "/state", "meaning",
                       std::vector<std::string>{"separated", "stick", "slip", "held"});
}

template <int dim>
void StaticContactAnalysis<dim>::write_static_file(const RunContext &context) const
{
  const std::string path = context.file("dynamics.h5"), u = "/snapshots/displacement";
  std::optional<Hdf5File> file;
  on_root(context.communicator(), [&]() {
    file.emplace(body->create_file(path, dynamics_format));
    write_run_conditions(*file, parameters.stated_conditions());
    write_dataset(*file, "/snapshots/time", {1}, std::vector<double>{0.}, "s");
    write_contact_group(*file);
  });
  const std::vector<ShownFields> shown = {
    {"displacement", u, {&result.solution.displacement}, "m"}};
  body->write_and_show(file, path, shown, {0.});
  if (context.root())
    body->write_below(context.file("counter_body.h5"), dynamics_format, shown, {0.},
                      parameters.stated_conditions());
}

template <int dim>
void StaticContactAnalysis<dim>::summarize(RunContext &context) const
{
  body->summarize("static contact", context);
  const StaticContactSolution &s = result.solution;
  const FrictionParameters &mu   = parameters.friction;
  nlohmann::json &json           = context.summary();
  json.update(
    {{"rve_digest", facts.rve_digest},
     {"pressure", parameters.top.pressure.amplitude()},
     {"flat_velocity", parameters.contact.flat_velocity.amplitude()},
     {"friction_coefficient",
      mu.coefficient_by_phase ? nlohmann::json() : nlohmann::json(mu.coefficient)},
     {"normal_force", result.normal_force},
     {"iterations", s.iterations},
     {"state_changes", s.state_changes},
     {"solver_iterations", s.solver_iterations},
     {"residual", s.residual},
     {"friction_change", s.friction_change}});
  for (unsigned int c = 0; c + 1 < dim; ++c)
    json[along_flat("tangential_force", c)] = result.tangential_force[c];
  add_pressures(result.phases, json);
  for (const ContactState state :
       {ContactState::stick, ContactState::slip, ContactState::separated})
    json["nodes"][to_string(state)] = count(state);
}

template <int dim>
void StaticContactAnalysis<dim>::run(RunContext &context)
{
  body->log(context);
  context.remove_results({"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf",
                          "static_contact.csv", "load_steps.csv", "counter_body.h5",
                          "counter_body.xdmf", "counter_body-phases.xdmf"});
  StaticContactOptions options = parameters.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  body->make_elastic(context.communicator());
  {
    const auto scope = context.timer().scope("Equilibrium");
    with_advice(equilibrium_advice(facts.size.friction,
                                   parameters.contact.flat_velocity.amplitude() != 0.),
                [&]() { result = compute_static_contact(*body, options); });
  }
  const NodalField<double> &u = result.solution.displacement;
  const std::vector<double> displaced =
    body->elastic().surface_values(ElasticBody<dim>::bottom, u);
  judge_static_strain(*body, u, context);
  log_result(context);
  const auto scope = context.timer().scope("Output");
  write_static_file(context);
  if (!context.root())
    return;
  write_contact_table(context, displaced);
  if (parameters.static_load.has_history())
    write_step_table(context);
  summarize(context);
}

template class StaticContactAnalysis<2>;
template class StaticContactAnalysis<3>;
} // namespace mesoslip
