#include "sliding/mesh/statics/mesh_static.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "exchange/datasets.h"
#include "exchange/dynamics_file.h"
#include "exchange/xdmf.h"
#include "io/drafts.h"
#include "io/table.h"
#include "material/plausibility.h"
#include "program/run_context.h"
#include "sliding/body_analysis.h"
#include "sliding/mesh/mesh_analysis.h"
#include "sliding/mesh/mesh_file.h"
#include "sliding/mesh/statics/mesh_pressures.h"
#include "sliding/mesh/statics/mesh_static_load.h"
#include "sliding/transient/run_draft.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace mesoslip
{
namespace
{
/** Of component @p c along the flat: the name alone is that along x. */
std::string along_flat(const std::string &name, const std::size_t c)
{
  return c == 0 ? name : name + "_y";
}

template <int dim>
class MeshStatic : public MeshAnalysis<dim>
{
public:
  explicit MeshStatic(const ContactParameters &given)
    : MeshAnalysis<dim>(given)
  {
    check_mesh_static<dim>(this->parameters, this->body.friction);
  }

  void write_draft(const std::string &folder) const override
  {
    on_root(MPI_COMM_WORLD, [&]() {
      const DraftMark mark(false);
      Hdf5File file = create_mesh_file(path_of_draft(folder, "dynamics.h5"),
                                       "mesoslip-dynamics", this->morphology, this->body);
      write_static_draft(file, this->parameters, vectors_shape(this->morphology));
      file.close();
    });
  }

  void run(RunContext &context) override;

private:
  std::optional<double> sliding_friction() const;
  void evaluate();
  void write_contact_table(const RunContext &context) const;
  void write_step_table(const RunContext &context) const;
  void write_static_file(const RunContext &context, const MeshBody<dim> &elastic) const;
  void write_contact_group(Hdf5File &file) const;
  void summarize(RunContext &context) const;

  std::size_t count(const ContactState state) const
  {
    return static_cast<std::size_t>(
      std::count(solution.state.begin(), solution.state.end(), state));
  }

  StaticContactSolution solution;
  std::vector<double> displaced; ///< dim components of each contact node (m)
  std::vector<StaticLoadStep> steps;
  std::vector<double> pressure;                   ///< of the contact nodes (Pa)
  std::array<std::vector<double>, dim - 1> shear; ///< likewise, on the body (Pa)
};

/** Friction along the motion of the flat over the normal force; nothing where it rests. */
template <int dim>
std::optional<double> MeshStatic<dim>::sliding_friction() const
{
  const ContactSetup &flat = this->parameters.contact;
  if (flat.flat_velocity.amplitude() == 0.)
    return std::nullopt;
  double along = 0.;
  for (unsigned int c = 0; c + 1 < dim; ++c)
    along += flat.flat_direction[c] * total_tangential_force(solution, c, dim - 1);
  return std::fabs(along) / total_normal_force(solution);
}

template <int dim>
void MeshStatic<dim>::evaluate()
{
  for (std::size_t i = 0; i < solution.state.size(); ++i)
    {
      // A node on faces that stand on the flat has no area.
      const double area  = std::fabs(this->body.contact.area[i]);
      const auto by_area = [&](const double force) {
        return force == 0. ? 0. : force / area;
      };
      pressure.push_back(by_area(solution.normal_force[i]));
      for (unsigned int c = 0; c + 1 < dim; ++c)
        shear[c].push_back(by_area(solution.tangential_force[(dim - 1) * i + c]));
    }
}

template <int dim>
void MeshStatic<dim>::write_contact_table(const RunContext &context) const
{
  std::vector<std::string> columns;
  const auto add = [&](const std::string &name, const unsigned int n, const char *unit) {
    for (unsigned int c = 0; c < n; ++c)
      columns.push_back(name + "xyz"[c] + unit);
  };
  add("", dim, " [m]");
  columns.emplace_back("pressure [Pa]");
  for (unsigned int c = 0; c + 1 < dim; ++c)
    columns.push_back(along_flat("shear_traction", c) + " [Pa]");
  columns.emplace_back("friction_coefficient [-]");
  add("displacement_", dim, " [m]");
  columns.emplace_back("state");
  TableWriter table(context.file("static_contact.csv"), columns);
  for (std::size_t i = 0; i < pressure.size(); ++i)
    {
      const unsigned int point = this->body.contact.points[i];
      std::vector<std::string> row;
      for (unsigned int c = 0; c < dim; ++c)
        row.push_back(to_text(this->morphology.mesh.points[point][c]));
      row.push_back(to_text(pressure[i]));
      for (const std::vector<double> &component : shear)
        row.push_back(to_text(component[i]));
      row.push_back(to_text(this->body.friction[i]));
      for (unsigned int c = 0; c < dim; ++c)
        row.push_back(to_text(displaced[dim * i + c]));
      row.push_back(to_string(solution.state[i]));
      table.add_row(row);
    }
  table.flush();
}

template <int dim>
void MeshStatic<dim>::write_step_table(const RunContext &context) const
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
  for (const StaticLoadStep &step : steps)
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
void MeshStatic<dim>::write_contact_group(Hdf5File &file) const
{
  const std::string group = "/static_contact";
  std::array<std::vector<double>, dim> place;
  for (const unsigned int point : this->body.contact.points)
    for (unsigned int c = 0; c < dim; ++c)
      place[c].push_back(this->morphology.mesh.points[point][c]);
  std::vector<Series> series = {
    {"pressure", "Pa", &pressure},
    {"friction_coefficient", "-", &this->body.friction},
    {"area", dim == 2 ? "m" : "m^2", &this->body.contact.area}};
  for (unsigned int c = 0; c < dim; ++c)
    series.push_back({std::string(1, "xyz"[c]), "m", &place[c]});
  for (unsigned int c = 0; c + 1 < dim; ++c)
    series.push_back({along_flat("shear_traction", c), "Pa", &shear[c]});
  write_series(file, group, series);
  std::vector<std::uint8_t> state;
  for (const ContactState of_node : solution.state)
    state.push_back(static_cast<std::uint8_t>(of_node));
  write_dataset(file, group + "/state", {state.size()}, state);
  file.write_attribute(group + "/state", "meaning",
                       std::vector<std::string>{"separated", "stick", "slip", "held"});
  write_dataset(file, group + "/point", {state.size()}, this->body.contact.points);
}

template <int dim>
void MeshStatic<dim>::write_static_file(const RunContext &context,
                                        const MeshBody<dim> &elastic) const
{
  const std::string path = context.file("dynamics.h5"), u = "/snapshots/displacement";
  std::optional<Hdf5File> file;
  on_root(context.communicator(), [&]() {
    file.emplace(
      create_mesh_file(path, "mesoslip-dynamics", this->morphology, this->body));
    write_run_conditions(*file, this->parameters.stated_conditions());
    write_dataset(*file, "/snapshots/time", {1}, std::vector<double>{0.}, "s");
    write_contact_group(*file);
  });
  write_divided_fields(file, path, u, {&solution.displacement}, this->morphology,
                       elastic);
  if (!context.root())
    return;
  file->write_unit(u, "m");
  file->close();
  show_body(context.file("dynamics.xdmf"), "dynamics.h5", this->morphology,
            {{"displacement", u, XdmfField::Values::nodes, {dim}}}, {0.});
  show_mesh_phases(context.file("dynamics-phases.xdmf"), "dynamics.h5", this->morphology);
}

template <int dim>
void MeshStatic<dim>::summarize(RunContext &context) const
{
  this->summarize_body("static contact", context);
  nlohmann::json &json = context.summary();
  json["pressure"]     = this->parameters.top.pressure.amplitude();
  json["normal_force"] = total_normal_force(solution);
  for (unsigned int c = 0; c + 1 < dim; ++c)
    json[along_flat("tangential_force", c)] =
      total_tangential_force(solution, c, dim - 1);
  json["iterations"]        = solution.iterations;
  json["state_changes"]     = solution.state_changes;
  json["solver_iterations"] = solution.solver_iterations;
  json["residual"]          = solution.residual;
  json["friction_change"]   = solution.friction_change;
  for (const ContactState state :
       {ContactState::stick, ContactState::slip, ContactState::separated})
    json["nodes"][to_string(state)] = count(state);
}

template <int dim>
void MeshStatic<dim>::run(RunContext &context)
{
  this->log_body(context);
  context.remove_results({"dynamics.h5", "dynamics.xdmf", "dynamics-phases.xdmf",
                          "static_contact.csv", "load_steps.csv"});
  StaticContactOptions options = this->parameters.static_contact;
  options.before_iteration     = stop_or_report(context, "iteration");
  const auto elastic           = this->divide_body();
  this->order_contact(*elastic);
  {
    const auto scope = context.timer().scope("Equilibrium");
    with_advice(
      equilibrium_advice(this->body.friction,
                         this->parameters.contact.flat_velocity.amplitude() != 0.),
      [&]() {
        const DofMask held = this->held_by_mesh(this->parameters.top, *elastic);
        MeshStaticLoad<dim> load(this->parameters, this->body, *elastic, held,
                                 this->phases[0].stiffness(dim - 1, dim - 1));
        solution = load.follow(options);
        steps    = load.steps();
      });
  }
  displaced = elastic->surface_values(ElasticBody<dim>::bottom, solution.displacement);
  evaluate();
  context.log(brief_text(4, solution.state.size() - count(ContactState::separated),
                         " nodes in contact (", count(ContactState::stick), " stick), ",
                         count(ContactState::separated), " separated; ",
                         solution.iterations, " iterations, ", solution.solver_iterations,
                         " of the solver"));
  judge_static_strain(
    largest_deformation(elastic->local_mesh().points, elastic->local_mesh().cells,
                        elastic->cell_numbers(), solution.displacement,
                        context.communicator()),
    this->parameters, this->body.scales, MeshAnalysis<dim>::place_of_cell, context);
  const auto scope = context.timer().scope("Output");
  const PhasePressures of_phases =
    mesh_phase_pressures(this->morphology, this->parameters, *elastic,
                         solution.displacement, total_normal_force(solution));
  write_static_file(context, *elastic);
  if (!context.root())
    return;
  for (const std::string &line : pressure_lines(of_phases, sliding_friction()))
    context.log(line);
  write_contact_table(context);
  if (this->parameters.static_load.has_history())
    write_step_table(context);
  summarize(context);
  add_pressures(of_phases, context.summary());
}
} // namespace

std::unique_ptr<Analysis> make_mesh_static(const ContactParameters &parameters)
{
  if (parameters.mesh.mesh.dim == 2)
    return std::make_unique<MeshStatic<2>>(parameters);
  return std::make_unique<MeshStatic<3>>(parameters);
}
} // namespace mesoslip
