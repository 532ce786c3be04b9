#include "sliding/transient/result_file.h"

#include "exchange/datasets.h"
#include "program/run_context.h"

namespace mesoslip
{
namespace
{
void write_history(Hdf5File &file, const TransientResult &run, const RunContext &context)
{
  const ContactHistory &h = run.history;
  const std::string force = run.body.unit("N"), energy = run.body.unit("J");
  const std::vector<Series> columns = {
    {"time", "s", &h.time},
    {"apparent_friction", "-", &run.apparent_friction},
    {"contact_normal_force", force, &h.normal_force},
    {"contact_tangential_force", force, &h.tangential_force},
    {"friction_energy", energy, &h.friction_energy},
    {"impact_energy", energy, &h.impact_energy},
    {"sticking_nodes", "-", &h.sticking},
    {"slipping_nodes", "-", &h.slipping},
    {"separated_nodes", "-", &h.separated},
    {"top_normal_force", force, &run.top.normal_force},
    {"top_tangential_force", force, &run.top.tangential_force},
    {"top_displacement", "m", &run.top.displacement}};
  write_series(file, "/history", columns);
  // A spreadsheet cannot use a million rows.
  write_table(context.file("history.csv"), columns, 5000);
}

void write_energy(Hdf5File &file, const TransientResult &run, const RunContext &context)
{
  const EnergyHistory &e             = run.energy;
  const std::string unit             = run.body.unit("J");
  const std::vector<double> residual = e.residual();
  std::vector<Series> columns        = {{"time", "s", &e.time},
                                        {"kinetic", unit, &e.kinetic},
                                        {"elastic", unit, &e.elastic},
                                        {"potential", unit, &e.potential},
                                        {"external_work", unit, &e.external_work},
                                        {"friction", unit, &e.friction},
                                        {"impact", unit, &e.impact},
                                        {"damping", unit, &e.damping},
                                        {"scheme", unit, &e.scheme},
                                        {"residual", unit, &residual}};
  if (run.parameters.contact.is_compliant() || run.parameters.contact.slips_on_springs())
    columns.insert(columns.end() - 1, {"contact", unit, &e.contact});
  if (run.parameters.supports_keep_energy())
    columns.insert(columns.end() - 1,
                   {{"supports", unit, &e.supports}, {"dashpots", unit, &e.dashpots}});
  write_series(file, "/energy", columns);
  file.write_attribute("/energy", "initial", e.initial);
  file.write_attribute("/energy", "unit", unit);
  write_table(context.file("energy.csv"), columns);
}

void write_probe(Hdf5File &file,
                 const std::string &group,
                 const ProbeHistory &probe,
                 const unsigned int dim)
{
  write_series(file, group,
               {{"time", "s", &probe.time},
                {"displacement", "m", &probe.displacement, dim},
                {"velocity", "m/s", &probe.velocity, dim}});
  for (const Series &series : {Series{"strain", "-", &probe.strain, dim * (dim + 1) / 2},
                               Series{"stress", "Pa", &probe.stress, dim * (dim + 1) / 2},
                               Series{"traction", "Pa", &probe.traction, dim}})
    if (!series.values->empty())
      write_series(file, group, {series});
  file.write_attribute(
    group, "position",
    std::vector<double>(probe.position.begin(), probe.position.begin() + dim));
  file.write_attribute(group, "phase", probe.phase);
}

/** Interleaves components along, across (in 3D) the motion of the flat and along its
 * normal, divided by @p divisor. */
std::vector<double> vectors(const std::vector<double> &along,
                            const std::vector<double> &across,
                            const std::vector<double> &normal,
                            const double divisor = 1.)
{
  std::vector<double> values;
  for (std::size_t k = 0; k < along.size(); ++k)
    {
      values.push_back(along[k] / divisor);
      if (!across.empty())
        values.push_back(across[k] / divisor);
      values.push_back(normal[k] / divisor);
    }
  return values;
}

/** Written from the contact histories, which contain the reference node. */
void write_reference_node(Hdf5File &file, const TransientResult &run)
{
  const MonitoredNode &node      = run.history.nodes[0];
  const ReferenceNode &reference = run.body.reference;
  ProbeHistory probe;
  probe.position     = reference.position;
  probe.phase        = reference.phase;
  probe.time         = run.history.time;
  probe.displacement = vectors(node.ux, node.across.u, node.uy);
  probe.velocity     = vectors(node.vx, node.across.v, node.vy);
  probe.traction =
    vectors(node.tangential_force, node.across.force, node.normal_force, reference.area);
  write_probe(file, "/reference", probe, run.body.dim);
  write_series(file, "/reference", {{"gap", "m", &node.gap}});
}

/** Writes shares of time; on a periodic grid the last node is a copy of the first. */
void write_states(Hdf5File &file, const TransientResult &run)
{
  const std::size_t n_nodes = run.body.friction.size(),
                    n       = run.contact.node_shares.size();
  std::vector<double> slip, stick, separated;
  for (std::size_t i = 0; i < n_nodes && n > 0; ++i)
    {
      const ContactShares &shares = run.contact.node_shares[i % n];
      slip.push_back(shares.slip);
      stick.push_back(shares.stick);
      separated.push_back(shares.separation);
    }
  write_series(file, "/contact",
               {{"friction_coefficient", "-", &run.body.friction},
                {"slip", "-", &slip},
                {"stick", "-", &stick},
                {"separated", "-", &separated}});
}

void write_blocks(Hdf5File &file, const TransientResult &run)
{
  const std::size_t n_nodes = run.body.friction.size();
  std::vector<double> times;
  std::vector<float> slip, stick, separated;
  for (const NodeCounts &block : run.blocks)
    {
      const auto n_steps = static_cast<float>(block.n_steps);
      times.push_back(static_cast<double>(block.first_step + block.n_steps) *
                      run.time.step.dt);
      for (std::size_t i = 0; i < n_nodes; ++i)
        {
          const std::size_t counted = i % run.body.n_contact_nodes;
          slip.push_back(block.slip[counted] / n_steps);
          stick.push_back(block.stick[counted] / n_steps);
          separated.push_back(1.f - slip.back() - stick.back());
        }
    }
  const Shape shape = {times.size(), n_nodes};
  write_series(file, "/contact/blocks", {{"time", "s", &times}});
  write_dataset(file, "/contact/blocks/slip", shape, slip);
  write_dataset(file, "/contact/blocks/stick", shape, stick);
  write_dataset(file, "/contact/blocks/separated", shape, separated);
}

/** Expands values of @p of_distinct nodes to all nodes; on a periodic grid the last is a
 * copy of the first. */
std::vector<double> of_all_nodes(const TransientResult &run,
                                 std::vector<double> of_distinct)
{
  for (std::size_t i = of_distinct.size(); i < run.body.friction.size(); ++i)
    of_distinct.push_back(of_distinct[i - run.body.n_contact_nodes]);
  return of_distinct;
}

/** Writes mean loads in the steady part and in the blocks, and the friction work of the
 * run. */
void write_loads(Hdf5File &file, const TransientResult &run)
{
  const double dt                     = run.time.step.dt;
  const std::size_t last              = run.blocks.size() - 1;
  const std::vector<double> &all_area = run.body.area;
  const std::vector<double> area(all_area.begin(),
                                 all_area.begin() + run.body.n_contact_nodes);
  const NodeMeans steady =
    mean_loads(run.blocks, first_block(run.blocks, dt, run.steady_from), last, area, dt);
  std::vector<double> work = run.blocks[last].loads.friction_energy;
  for (std::size_t i = 0; i < area.size(); ++i)
    work[i] /= area[i];
  work                               = of_all_nodes(run, work);
  const std::vector<double> pressure = of_all_nodes(run, steady.pressure),
                            power    = of_all_nodes(run, steady.friction_power);
  write_series(file, "/contact",
               {{"pressure", "Pa", &pressure},
                {"friction_power", "W/m^2", &power},
                {"friction_work", "J/m^2", &work}});
  std::vector<double> pressures, powers;
  for (std::size_t b = 0; b <= last; ++b)
    {
      const NodeMeans means = mean_loads(run.blocks, b, b, area, dt);
      for (const double p : of_all_nodes(run, means.pressure))
        pressures.push_back(p);
      for (const double p : of_all_nodes(run, means.friction_power))
        powers.push_back(p);
    }
  const Shape shape = {run.blocks.size(), run.body.friction.size()};
  write_dataset(file, "/contact/blocks/pressure", shape, pressures, "Pa");
  write_dataset(file, "/contact/blocks/friction_power", shape, powers, "W/m^2");
}

void write_motion(Hdf5File &file, const TransientResult &run)
{
  const Spectrum &spectrum = run.spectrum;
  if (!spectrum.frequency.empty())
    write_series(file, "/spectrum",
                 {{"frequency", "Hz", &spectrum.frequency},
                  {"amplitude", "m", &spectrum.amplitude}});
  const PhaseDiagram &phase = run.phase_diagram;
  if (phase.n_periods > 0)
    write_series(file, "/phase_diagram",
                 {{"displacement", "m", &phase.displacement},
                  {"velocity", "m/s", &phase.velocity},
                  {"displacement_spread", "m", &phase.displacement_spread},
                  {"velocity_spread", "m/s", &phase.velocity_spread}});
}
} // namespace

RunConditions conditions_of_result(const ContactParameters &parameters,
                                   const double dt,
                                   const double steady_from,
                                   const double steady_to,
                                   const bool limit_cycle_reached)
{
  RunConditions conditions          = parameters.stated_conditions();
  conditions["time_step"]           = dt;
  conditions["steady_from"]         = steady_from;
  conditions["steady_to"]           = steady_to;
  conditions["limit_cycle_reached"] = limit_cycle_reached ? "yes" : "no";
  return conditions;
}

void write_probes(Hdf5File &file,
                  const std::vector<ProbeHistory> &probes,
                  const unsigned int dim)
{
  for (const ProbeHistory &probe : probes)
    write_probe(file, "/probes/" + probe.name, probe, dim);
}

RunConditions conditions_of_result(const TransientResult &run)
{
  const double dt = run.time.step.dt;
  return conditions_of_result(run.parameters, dt, run.steady_from,
                              static_cast<double>(run.steps_done) * dt,
                              run.limit_cycle_reached);
}

void write_result(Hdf5File &file, const TransientResult &run, const RunContext &context)
{
  write_run_conditions(file, conditions_of_result(run));
  write_history(file, run, context);
  if (!run.energy.time.empty())
    write_energy(file, run, context);
  write_probes(file, run.probes, run.body.dim);
  if (!run.history.nodes.empty())
    write_reference_node(file, run);
  write_states(file, run);
  write_blocks(file, run);
  if (run.parameters.wants_node_loads() && !run.blocks.empty())
    write_loads(file, run);
  write_motion(file, run);
}
} // namespace mesoslip
