#include "sliding/transient/dynamics_file.h"

#include "base/errors.h"
#include "io/hdf5_file.h"
#include "io/table.h"
#include "program/run_context.h"
#include "sliding/body_file.h"
#include "sliding/stated_conditions.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
constexpr char snapshots_name[] = "/snapshots/displacement";

std::vector<double> node_positions(const UniformGrid<2> &grid)
{
  std::vector<double> x(grid.cells[0] + 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = i * grid.spacing[0];
  return x;
}
// As of a probe there: a point between two cells belongs to the upper one.
unsigned int reference_phase(const Scene &scene, const unsigned int node)
{
  return scene.phase_id.empty() ? 0
                                : scene.phase_id[std::min(node, scene.grid.cells[0] - 1)];
}
} // namespace

DynamicsFile::DynamicsFile(RunContext &context,
                           const ContactParameters &parameters,
                           const Scene &scene)
  : context(context)
  , parameters(parameters)
  , scene(scene)
{
}

DynamicsFile::~DynamicsFile() = default;

void DynamicsFile::begin_snapshots(const std::vector<double> &times,
                                   const std::uint64_t n_done)
{
  const std::string path = context.file("dynamics.h5");
  snapshot_times         = times;
  n_snapshots            = n_done;
  if (n_done == 0)
    create();
  else
    {
      const std::string remedy = "start again without --resume";
      file = std::make_unique<Hdf5File>(Hdf5File::resume(path, remedy));
      if (file->shape(snapshots_name, remedy)[0] < n_done)
        throw UserError(path + " has fewer than the " + std::to_string(n_done) +
                        " snapshots it had at the checkpoint; " + remedy);
      // What was observed when the run was stopped.
      for (const std::string &name : file->list("/"))
        if (name != "grid" && name != "material" && name != "snapshots")
          file->remove("/" + name);
    }
  file->reserve_rows(snapshots_name, snapshot_shape(scene.grid, times.size()));
  file->flush();
}

void DynamicsFile::create()
{
  file = std::make_unique<Hdf5File>(
    create_body_file(context.file("dynamics.h5"), "mesoslip-dynamics", scene));
}

void DynamicsFile::add_snapshot(const NodalField<double> &u)
{
  file->write_row(snapshots_name, n_snapshots, interleaved(u));
  ++n_snapshots;
}

std::uint64_t DynamicsFile::save_snapshots()
{
  if (file)
    file->sync();
  return n_snapshots;
}

void DynamicsFile::write_snapshots()
{
  snapshot_times.resize(n_snapshots);
  file->reserve_rows(snapshots_name, snapshot_shape(scene.grid, n_snapshots));
  complete_snapshots(*file, snapshot_times);
  if (n_snapshots > 0)
    write_body_xdmf(context.file("dynamics.xdmf"), scene, "dynamics.h5",
                    {{"displacement", snapshots_name}}, snapshot_times);
}

void DynamicsFile::write_column(const std::string &name,
                                const std::vector<double> &values,
                                const std::string &unit)
{
  file->write(name, {values.size()}, values);
  file->write_unit(name, unit);
}

void DynamicsFile::write_history(const TransientObservations &observed,
                                 const TransientSummary &summary)
{
  const ContactHistory &h = observed.contact;
  const std::vector<std::pair<std::string, const std::vector<double> *>> columns = {
    {"time [s]", &h.time},
    {"apparent_friction [-]", &summary.apparent_friction},
    {"contact_normal_force [N/m]", &h.normal_force},
    {"contact_tangential_force [N/m]", &h.tangential_force},
    {"friction_energy [J/m]", &h.friction_energy},
    {"impact_energy [J/m]", &h.impact_energy},
    {"sticking_nodes [-]", &h.sticking},
    {"slipping_nodes [-]", &h.slipping},
    {"separated_nodes [-]", &h.separated},
    {"top_normal_force [N/m]", &observed.top.normal_force},
    {"top_tangential_force [N/m]", &observed.top.tangential_force},
    {"top_displacement [m]", &observed.top.displacement}};

  std::vector<std::string> headings;
  std::size_t n = h.time.size();
  for (const auto &[heading, values] : columns)
    {
      headings.push_back(heading);
      n                       = std::min(n, values->size());
      const std::size_t split = heading.find(" [");
      const std::string name  = "/history/" + heading.substr(0, split);
      write_column(name, *values, heading.substr(split + 2, heading.size() - split - 3));
    }
  // A spreadsheet has no use for a million rows.
  const std::size_t stride = std::max<std::size_t>(1, n / 5000);
  TableWriter table(context.file("history.csv"), headings);
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < n; k += stride)
    {
      for (std::size_t c = 0; c < columns.size(); ++c)
        row[c] = (*columns[c].second)[k];
      table.add_row(row);
    }
  table.flush();
}

void DynamicsFile::write_energy(const EnergyHistory &e)
{
  const std::vector<double> residual = e.residual();
  const std::vector<std::pair<std::string, const std::vector<double> *>> columns = {
    {"time", &e.time},
    {"kinetic", &e.kinetic},
    {"elastic", &e.elastic},
    {"potential", &e.potential},
    {"external_work", &e.external_work},
    {"friction", &e.friction},
    {"impact", &e.impact},
    {"damping", &e.damping},
    {"scheme", &e.scheme},
    {"residual", &residual}};
  std::vector<std::string> headings;
  for (const auto &[name, values] : columns)
    {
      const std::string unit = name == "time" ? "s" : "J/m";
      write_column("/energy/" + name, *values, unit);
      headings.push_back(name + " [" + unit + "]");
    }
  file->write_attribute("/energy", "initial", e.initial);
  file->write_attribute("/energy", "unit", std::string("J/m"));
  TableWriter table(context.file("energy.csv"), headings);
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < e.time.size(); ++k)
    {
      for (std::size_t c = 0; c < columns.size(); ++c)
        row[c] = (*columns[c].second)[k];
      table.add_row(row);
    }
  table.flush();
}

void DynamicsFile::write_probes(const TransientObservations &observed)
{
  const auto write = [&](const ProbeHistory &probe, const std::string &group) {
    const std::size_t n = probe.time.size();
    write_column(group + "/time", probe.time, "s");
    const auto write_components =
      [&](const std::string &name, const std::size_t components,
          const std::vector<double> &values, const std::string &unit) {
        if (values.empty() && components > 2)
          return;
        file->write(group + name, {n, components}, values);
        file->write_unit(group + name, unit);
      };
    write_components("/displacement", 2, probe.displacement, "m");
    write_components("/velocity", 2, probe.velocity, "m/s");
    write_components("/strain", 3, probe.strain, "-");
    write_components("/stress", 3, probe.stress, "Pa");
    if (!probe.traction.empty())
      write_components("/traction", 2, probe.traction, "Pa");
    file->write_attribute(group, "position",
                          std::vector<double>{probe.position[0], probe.position[1]});
    file->write_attribute(group, "phase", probe.phase);
  };
  for (const ProbeHistory &probe : observed.probes)
    write(probe, "/probes/" + probe.name);

  // The reference contact node comes with the histories of the contact.
  const ContactHistory &h = observed.contact;
  if (h.nodes.empty())
    return;
  const MonitoredNode &node = h.nodes[0];
  const double dx           = scene.grid.spacing[0];
  const bool end =
    observed.reference_node == 0 || observed.reference_node == scene.grid.cells[0];
  const double width = end && !parameters.periodic ? 0.5 * dx : dx;
  ProbeHistory reference;
  reference.position = {{observed.reference_node * dx, 0.}};
  reference.phase    = reference_phase(scene, observed.reference_node);
  reference.time     = h.time;
  for (std::size_t k = 0; k < h.time.size() && k < node.vx.size(); ++k)
    {
      reference.displacement.insert(reference.displacement.end(),
                                    {node.ux[k], node.uy[k]});
      reference.velocity.insert(reference.velocity.end(), {node.vx[k], node.vy[k]});
      reference.traction.insert(
        reference.traction.end(),
        {node.tangential_force[k] / width, node.normal_force[k] / width});
    }
  write(reference, "/reference");
}

void DynamicsFile::write_contact(const TransientObservations &observed,
                                 const TransientSummary &summary)
{
  const std::vector<double> x = node_positions(scene.grid);
  const std::size_t n_nodes = x.size(), n_blocks = observed.blocks.size();
  write_column("/contact/x", x, "m");
  write_column("/contact/friction_coefficient", scene.node_friction, "-");
  std::vector<double> slip, stick, separated;
  for (const ContactShares &shares : summary.contact.node_shares)
    {
      slip.push_back(shares.slip);
      stick.push_back(shares.stick);
      separated.push_back(shares.separation);
    }
  if (parameters.periodic && !slip.empty())
    for (std::vector<double> *shares : {&slip, &stick, &separated})
      shares->push_back(shares->front()); // the last node is the first one again
  write_column("/contact/slip", slip, "-");
  write_column("/contact/stick", stick, "-");
  write_column("/contact/separated", separated, "-");

  std::vector<double> times;
  std::vector<float> block_slip, block_stick, block_separated;
  for (const NodeCounts &block : observed.blocks)
    {
      times.push_back((block.first_step + block.n_steps) * observed.dt);
      for (std::size_t i = 0; i < n_nodes; ++i)
        {
          // With periodic sides the last node is the first one again and is not counted.
          const std::size_t counted = parameters.periodic && i + 1 == n_nodes ? 0 : i;
          block_slip.push_back(block.slip[counted] / block.n_steps);
          block_stick.push_back(block.stick[counted] / block.n_steps);
          block_separated.push_back(1.f - block_slip.back() - block_stick.back());
        }
    }
  write_column("/contact/blocks/time", times, "s");
  file->write("/contact/blocks/slip", {n_blocks, n_nodes}, block_slip);
  file->write("/contact/blocks/stick", {n_blocks, n_nodes}, block_stick);
  file->write("/contact/blocks/separated", {n_blocks, n_nodes}, block_separated);
  for (const char *state : {"slip", "stick", "separated"})
    file->write_unit(std::string("/contact/blocks/") + state, "-");
}

void DynamicsFile::write_evaluation(const TransientSummary &summary)
{
  if (!summary.spectrum.frequency.empty())
    {
      write_column("/spectrum/frequency", summary.spectrum.frequency, "Hz");
      write_column("/spectrum/amplitude", summary.spectrum.amplitude, "m");
    }
  const PhaseDiagram &phase = summary.phase_diagram;
  if (phase.n_periods > 0)
    {
      write_column("/phase_diagram/displacement", phase.displacement, "m");
      write_column("/phase_diagram/velocity", phase.velocity, "m/s");
      write_column("/phase_diagram/displacement_spread", phase.displacement_spread, "m");
      write_column("/phase_diagram/velocity_spread", phase.velocity_spread, "m/s");
    }
}

void DynamicsFile::write_conditions(const TransientObservations &observed)
{
  RunConditions conditions                = stated_conditions(parameters);
  conditions.numbers["time_step"]         = observed.dt;
  conditions.numbers["steady_from"]       = observed.steady_from;
  conditions.numbers["steady_to"]         = observed.steps_done * observed.dt;
  conditions.words["limit_cycle_reached"] = observed.limit_cycle_reached ? "yes" : "no";
  write_run_conditions(*file, conditions);
}

void DynamicsFile::write(const TransientObservations &observed,
                         const TransientSummary &summary)
{
  if (file)
    write_snapshots();
  else
    create();
  write_conditions(observed);
  write_history(observed, summary);
  if (!observed.energy.time.empty())
    write_energy(observed.energy);
  write_probes(observed);
  write_contact(observed, summary);
  write_evaluation(summary);
  file->close();
  file.reset();
}
} // namespace mesoslip
