#include "sliding/transient/dynamics_output.h"

#include "base/exchange.h"
#include "exchange/datasets.h"
#include "grid/row_partition.h"
#include "program/run_context.h"
#include "sliding/transient/result_file.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** x and y by turns, over @p divisor. */
std::vector<double> pairs(const std::vector<double> &x,
                          const std::vector<double> &y,
                          const double divisor = 1.)
{
  std::vector<double> values;
  for (std::size_t k = 0; k < x.size(); ++k)
    values.insert(values.end(), {x[k] / divisor, y[k] / divisor});
  return values;
}
} // namespace

// The steps nearest to From, From + Interval, ... up to To, or every step.
DynamicsOutput::DynamicsOutput(RunContext &context,
                               const ContactParameters &parameters,
                               const BodyDescription &body,
                               const TimeStepChoice &time)
  : context(context)
  , body(body)
  , dt(time.step.dt)
{
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return;
  // Beyond the last step there is none to be seen, nor between two steps.
  const double from = o.snapshots_from, spacing = std::max(o.snapshots_interval, dt),
               to = std::isnan(o.snapshots_to)
                      ? parameters.time.end_time
                      : std::min(o.snapshots_to, (time.n_steps + 1) * dt);
  const auto n    = static_cast<std::uint64_t>(std::floor((to - from) / spacing + 1e-6));
  for (std::uint64_t k = 0; k <= n && to >= from; ++k)
    {
      const auto step =
        static_cast<std::uint64_t>(std::llround((from + k * spacing) / dt));
      if (steps.empty() || step > steps.back())
        steps.push_back(step);
    }
}

void DynamicsOutput::begin_snapshots(const Stepper &of_stepper,
                                     const std::uint64_t n_done)
{
  stepper     = &of_stepper;
  n_snapshots = n_done;
  on_root(context.communicator(), [&]() {
    const std::string path = context.file("dynamics.h5");
    file.emplace(n_done == 0 ? DynamicsFile::create(path, body)
                             : DynamicsFile::resume(path, n_done));
    file->reserve_snapshots(steps.size());
    file->flush();
  });
}

std::uint64_t DynamicsOutput::next_step(const std::uint64_t n) const
{
  const auto next = std::lower_bound(steps.begin(), steps.end(), n);
  return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
}

void DynamicsOutput::before_step(const std::uint64_t)
{
  const NodalField<double> whole =
    gather_rows(stepper->u, stepper->rows, stepper->communicator);
  if (!context.root())
    return;
  const auto scope = context.timer().scope("Writing snapshots");
  file->write_snapshot(n_snapshots++, whole);
}

std::uint64_t DynamicsOutput::save_snapshots()
{
  if (file)
    file->sync();
  return n_snapshots;
}

void DynamicsOutput::write_history(const TransientResult &run)
{
  const ContactHistory &h           = run.history;
  const std::vector<Series> columns = {
    {"time", "s", &h.time},
    {"apparent_friction", "-", &run.apparent_friction},
    {"contact_normal_force", "N/m", &h.normal_force},
    {"contact_tangential_force", "N/m", &h.tangential_force},
    {"friction_energy", "J/m", &h.friction_energy},
    {"impact_energy", "J/m", &h.impact_energy},
    {"sticking_nodes", "-", &h.sticking},
    {"slipping_nodes", "-", &h.slipping},
    {"separated_nodes", "-", &h.separated},
    {"top_normal_force", "N/m", &run.top.normal_force},
    {"top_tangential_force", "N/m", &run.top.tangential_force},
    {"top_displacement", "m", &run.top.displacement}};
  write_series(*file, "/history", columns);
  // A spreadsheet has no use for a million rows.
  write_table(context.file("history.csv"), columns, 5000);
}

void DynamicsOutput::write_energy(const EnergyHistory &e)
{
  const std::vector<double> residual = e.residual();
  const std::vector<Series> columns  = {{"time", "s", &e.time},
                                        {"kinetic", "J/m", &e.kinetic},
                                        {"elastic", "J/m", &e.elastic},
                                        {"potential", "J/m", &e.potential},
                                        {"external_work", "J/m", &e.external_work},
                                        {"friction", "J/m", &e.friction},
                                        {"impact", "J/m", &e.impact},
                                        {"damping", "J/m", &e.damping},
                                        {"scheme", "J/m", &e.scheme},
                                        {"residual", "J/m", &residual}};
  write_series(*file, "/energy", columns);
  file->write_attribute("/energy", "initial", e.initial);
  file->write_attribute("/energy", "unit", std::string("J/m"));
  write_table(context.file("energy.csv"), columns);
}

/** It comes with the histories of the contact. */
void DynamicsOutput::write_reference_node(const TransientResult &run)
{
  const MonitoredNode &node    = run.history.nodes[0];
  const unsigned int number    = run.reference_node;
  const unsigned int last_cell = body.grid.cells[0] - 1;
  const double width = tributary_width(body.grid, number, run.parameters.periodic);
  ProbeHistory probe;
  probe.position = {{number * body.grid.spacing[0], 0., 0.}};
  // As of a probe there: a point between two cells belongs to the upper one.
  probe.phase        = body.phase_of(std::min(number, last_cell));
  probe.time         = run.history.time;
  probe.displacement = pairs(node.ux, node.uy);
  probe.velocity     = pairs(node.vx, node.vy);
  probe.traction     = pairs(node.tangential_force, node.normal_force, width);
  write_probe(*file, "/reference", probe, 2);
}

void DynamicsOutput::write_contact(const TransientResult &run)
{
  std::vector<double> x, slip, stick, separated;
  for (unsigned int i = 0; i <= body.grid.cells[0]; ++i)
    {
      x.push_back(i * body.grid.spacing[0]);
      if (run.contact.node_shares.empty())
        continue;
      // With periodic sides the last node is the first one again and is not counted.
      const ContactShares &shares =
        run.contact.node_shares[i % run.contact.node_shares.size()];
      slip.push_back(shares.slip);
      stick.push_back(shares.stick);
      separated.push_back(shares.separation);
    }
  write_series(*file, "/contact",
               {{"x", "m", &x},
                {"friction_coefficient", "-", &body.node_friction},
                {"slip", "-", &slip},
                {"stick", "-", &stick},
                {"separated", "-", &separated}});
  write_blocks(run);
}

void DynamicsOutput::write_blocks(const TransientResult &run)
{
  const std::size_t n_nodes = body.grid.cells[0] + std::size_t(1);
  std::vector<double> times;
  std::vector<float> slip, stick, separated;
  for (const NodeCounts &block : run.blocks)
    {
      times.push_back((block.first_step + block.n_steps) * dt);
      for (std::size_t i = 0; i < n_nodes; ++i)
        {
          const std::size_t counted = run.parameters.periodic && i + 1 == n_nodes ? 0 : i;
          slip.push_back(block.slip[counted] / block.n_steps);
          stick.push_back(block.stick[counted] / block.n_steps);
          separated.push_back(1.f - slip.back() - stick.back());
        }
    }
  const Shape shape = {times.size(), n_nodes};
  write_series(*file, "/contact/blocks", {{"time", "s", &times}});
  write_dataset(*file, "/contact/blocks/slip", shape, slip);
  write_dataset(*file, "/contact/blocks/stick", shape, stick);
  write_dataset(*file, "/contact/blocks/separated", shape, separated);
}

void DynamicsOutput::write(const TransientResult &run)
{
  if (file)
    {
      std::vector<double> times;
      for (std::size_t k = 0; k < n_snapshots; ++k)
        times.push_back(steps[k] * dt);
      file->reserve_snapshots(n_snapshots);
      file->complete_snapshots(times);
    }
  else
    file.emplace(DynamicsFile::create(context.file("dynamics.h5"), body));
  RunConditions conditions          = run.parameters.stated_conditions();
  conditions["time_step"]           = dt;
  conditions["steady_from"]         = run.steady_from;
  conditions["steady_to"]           = run.steps_done * dt;
  conditions["limit_cycle_reached"] = run.limit_cycle_reached ? "yes" : "no";
  write_run_conditions(*file, conditions);
  write_history(run);
  if (!run.energy.time.empty())
    write_energy(run.energy);
  for (const ProbeHistory &probe : run.probes)
    write_probe(*file, "/probes/" + probe.name, probe, 2);
  if (!run.history.nodes.empty())
    write_reference_node(run);
  write_contact(run);
  const Spectrum &spectrum = run.spectrum;
  if (!spectrum.frequency.empty())
    write_series(*file, "/spectrum",
                 {{"frequency", "Hz", &spectrum.frequency},
                  {"amplitude", "m", &spectrum.amplitude}});
  const PhaseDiagram &phase = run.phase_diagram;
  if (phase.n_periods > 0)
    write_series(*file, "/phase_diagram",
                 {{"displacement", "m", &phase.displacement},
                  {"velocity", "m/s", &phase.velocity},
                  {"displacement_spread", "m", &phase.displacement_spread},
                  {"velocity_spread", "m/s", &phase.velocity_spread}});
  file->close();
  file.reset();
}
} // namespace mesoslip
