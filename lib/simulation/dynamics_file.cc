#include "simulation/dynamics_file.h"

#include "io/digest.h"
#include "io/hdf5_file.h"
#include "io/run_context.h"
#include "io/table.h"
#include "io/xdmf.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
std::string
scene_digest(const Scene &scene)
{
  Digest digest;
  digest.add(scene.rve_digest);
  for (unsigned int d = 0; d < 2; ++d)
    digest.add(scene.grid.cells[d]).add(scene.grid.spacing[d]);
  for (const Phase<2> &phase : scene.phases)
    {
      for (int k = 0; k < phase.stiffness.size(); ++k)
        digest.add(phase.stiffness.data()[k]);
      digest.add(phase.density);
    }
  digest.add(std::string(scene.phase_id.begin(), scene.phase_id.end()));
  return digest.hex();
}

std::vector<double>
node_positions(const UniformGrid<2> &grid)
{
  std::vector<double> x(grid.cells[0] + 1);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] = i * grid.spacing[0];
  return x;
}
} // namespace

DynamicsFile::DynamicsFile(RunContext              &context,
                           const ContactParameters &parameters,
                           const Scene             &scene)
  : context(context)
  , parameters(parameters)
  , scene(scene)
{
  if (!context.root())
    return;
  file = std::make_unique<Hdf5File>(Hdf5File::create(context.file("dynamics.h5")));
  file->write_header("mesoslip-dynamics", 1, 2, scene_digest(scene));
  file->create_group("/grid");
  file->write_attribute("/grid",
                        "cells",
                        std::vector<unsigned int>(scene.grid.cells.begin(),
                                                  scene.grid.cells.end()));
  file->write_attribute("/grid",
                        "spacing",
                        std::vector<double>(scene.grid.spacing.begin(), scene.grid.spacing.end()));
  file->write_attribute("/grid",
                        "origin",
                        std::vector<double>(scene.grid.origin.begin(), scene.grid.origin.end()));
  write_material();
  if (parameters.observation.snapshots_interval > 0.)
    {
      file->create_extendable<double>("/snapshots/time", {});
      file->create_extendable<double>("/snapshots/displacement",
                                      {scene.grid.cells[1] + 1, scene.grid.cells[0] + 1, 2});
    }
}

DynamicsFile::~DynamicsFile() = default;

void
DynamicsFile::write_material()
{
  const std::size_t        n = scene.phases.size();
  std::vector<double>      stiffness, density;
  std::vector<std::string> names;
  for (const Phase<2> &phase : scene.phases)
    {
      stiffness.insert(stiffness.end(),
                       phase.stiffness.data(),
                       phase.stiffness.data() + phase.stiffness.size());
      density.push_back(phase.density);
      names.push_back(phase.name);
    }
  file->write("/material/stiffness", {n, 3, 3}, stiffness);
  file->write("/material/density", {n}, density);
  file->write_strings("/material/name", names);
  file->write_attribute("/material", "rve_digest", scene.rve_digest);
  if (!scene.phase_id.empty())
    file->write("/material/phase_id", {scene.grid.cells[1], scene.grid.cells[0]}, scene.phase_id);
}

void
DynamicsFile::add_snapshot(const double time, const NodalField<double> &u)
{
  const unsigned int n = u.n_columns();
  snapshot.resize(2 * static_cast<std::size_t>(n) * u.n_rows());
  std::size_t k = 0;
  for (unsigned int j = 0; j < u.n_rows(); ++j)
    {
      const double *x = u.row(0, j), *y = u.row(1, j);
      for (unsigned int i = 0; i < n; ++i)
        {
          snapshot[k++] = x[i];
          snapshot[k++] = y[i];
        }
    }
  file->append("/snapshots/time", time);
  file->append<double>("/snapshots/displacement", snapshot.data(), 1);
  snapshot_times.push_back(time);
}

void
DynamicsFile::write_column(const std::string &name, const std::vector<double> &values)
{
  file->write(name, {values.size()}, values);
}

void
DynamicsFile::write_history(const TransientObservations &observed,
                            const TransientSummary      &summary)
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
  std::size_t              n = h.time.size();
  for (const auto &[heading, values] : columns)
    {
      headings.push_back(heading);
      n = std::min(n, values->size());
      const std::size_t split = heading.find(" [");
      const std::string name  = "/history/" + heading.substr(0, split);
      write_column(name, *values);
      file->write_attribute(name,
                            "unit",
                            heading.substr(split + 2, heading.size() - split - 3));
    }
  // A spreadsheet has no use for a million rows.
  const std::size_t   stride = std::max<std::size_t>(1, n / 5000);
  TableWriter         table(context.file("history.csv"), headings);
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < n; k += stride)
    {
      for (std::size_t c = 0; c < columns.size(); ++c)
        row[c] = (*columns[c].second)[k];
      table.add_row(row);
    }
  table.flush();
}

void
DynamicsFile::write_energy(const EnergyHistory &e)
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
      write_column("/energy/" + name, *values);
      headings.push_back(name + (name == "time" ? " [s]" : " [J/m]"));
    }
  file->write_attribute("/energy", "initial", e.initial);
  TableWriter         table(context.file("energy.csv"), headings);
  std::vector<double> row(columns.size());
  for (std::size_t k = 0; k < e.time.size(); ++k)
    {
      for (std::size_t c = 0; c < columns.size(); ++c)
        row[c] = (*columns[c].second)[k];
      table.add_row(row);
    }
  table.flush();
}

void
DynamicsFile::write_probes(const TransientObservations &observed)
{
  const auto write = [&](const ProbeHistory &probe, const std::string &group) {
    const std::size_t n = probe.time.size();
    write_column(group + "/time", probe.time);
    file->write(group + "/displacement", {n, 2}, probe.displacement);
    file->write(group + "/velocity", {n, 2}, probe.velocity);
    if (!probe.strain.empty())
      {
        file->write(group + "/strain", {n, 3}, probe.strain);
        file->write(group + "/stress", {n, 3}, probe.stress);
      }
    if (!probe.traction.empty())
      file->write(group + "/traction", {n, 2}, probe.traction);
    file->write_attribute(group, "position", std::vector<double>{probe.position[0], probe.position[1]});
    file->write_attribute(group, "phase", probe.phase);
  };
  for (const ProbeHistory &probe : observed.probes)
    write(probe, "/probes/" + probe.name);

  // The reference contact node comes with the histories of the contact.
  const ContactHistory &h = observed.contact;
  if (h.nodes.empty())
    return;
  const MonitoredNode &node = h.nodes[0];
  const double         dx   = scene.grid.spacing[0];
  const bool           end =
    observed.reference_node == 0 || observed.reference_node == scene.grid.cells[0];
  const double width = end && !parameters.periodic ? 0.5 * dx : dx;
  ProbeHistory reference;
  reference.position = {{observed.reference_node * dx, 0.}};
  reference.time     = h.time;
  for (std::size_t k = 0; k < h.time.size() && k < node.vx.size(); ++k)
    {
      reference.displacement.insert(reference.displacement.end(), {node.ux[k], node.uy[k]});
      reference.velocity.insert(reference.velocity.end(), {node.vx[k], node.vy[k]});
      reference.traction.insert(reference.traction.end(),
                                {node.tangential_force[k] / width, node.normal_force[k] / width});
    }
  write(reference, "/reference");
}

void
DynamicsFile::write_contact(const TransientObservations &observed, const TransientSummary &summary)
{
  const std::vector<double> x       = node_positions(scene.grid);
  const std::size_t         n_nodes = x.size(), n_blocks = observed.blocks.size();
  write_column("/contact/x", x);
  write_column("/contact/friction_coefficient", scene.node_friction);
  std::vector<double> slip, stick, separated;
  for (const ContactShares &shares : summary.contact.node_shares)
    {
      slip.push_back(shares.slip);
      stick.push_back(shares.stick);
      separated.push_back(shares.separation);
    }
  write_column("/contact/slip", slip);
  write_column("/contact/stick", stick);
  write_column("/contact/separated", separated);

  std::vector<double> times;
  std::vector<float>  block_slip, block_stick, block_separated;
  for (const NodeCounts &block : observed.blocks)
    {
      times.push_back((block.first_step + block.n_steps) * observed.dt);
      for (std::size_t i = 0; i < n_nodes; ++i)
        {
          block_slip.push_back(block.slip[i] / block.n_steps);
          block_stick.push_back(block.stick[i] / block.n_steps);
          block_separated.push_back(1.f - block_slip.back() - block_stick.back());
        }
    }
  write_column("/contact/blocks/time", times);
  file->write("/contact/blocks/slip", {n_blocks, n_nodes}, block_slip);
  file->write("/contact/blocks/stick", {n_blocks, n_nodes}, block_stick);
  file->write("/contact/blocks/separated", {n_blocks, n_nodes}, block_separated);
}

void
DynamicsFile::write_evaluation(const TransientSummary &summary)
{
  if (!summary.spectrum.frequency.empty())
    {
      write_column("/spectrum/frequency", summary.spectrum.frequency);
      write_column("/spectrum/amplitude", summary.spectrum.amplitude);
    }
  const PhaseDiagram &phase = summary.phase_diagram;
  if (phase.n_periods > 0)
    {
      write_column("/phase_diagram/displacement", phase.displacement);
      write_column("/phase_diagram/velocity", phase.velocity);
      write_column("/phase_diagram/displacement_spread", phase.displacement_spread);
      write_column("/phase_diagram/velocity_spread", phase.velocity_spread);
    }
}

void
DynamicsFile::write(const TransientObservations &observed, const TransientSummary &summary)
{
  write_history(observed, summary);
  if (!observed.energy.time.empty())
    write_energy(observed.energy);
  write_probes(observed);
  write_contact(observed, summary);
  write_evaluation(summary);
  file->close();

  if (snapshot_times.empty())
    return;
  XdmfGrid grid;
  grid.cells   = {{scene.grid.cells[0], scene.grid.cells[1], 1}};
  grid.spacing = {{scene.grid.spacing[0], scene.grid.spacing[1], 1.}};
  XdmfField displacement;
  displacement.name        = "displacement";
  displacement.file        = "dynamics.h5";
  displacement.dataset     = "/snapshots/displacement";
  displacement.components  = 2;
  displacement.time_series = true;
  std::vector<XdmfField> fields = {displacement};
  if (!scene.phase_id.empty())
    {
      XdmfField phase;
      phase.name    = "phase";
      phase.file    = "dynamics.h5";
      phase.dataset = "/material/phase_id";
      phase.centre  = XdmfField::Centre::cell;
      phase.number  = XdmfField::Number::uint8;
      fields.push_back(phase);
    }
  write_xdmf(context.file("dynamics.xdmf"), grid, fields, snapshot_times);
}
} // namespace mesoslip
