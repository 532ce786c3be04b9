#include "sliding/transient/transient.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "grid/row_partition.h"
#include "io/drafts.h"
#include "material/plausibility.h"
#include "observation/grid_probes.h"
#include "parameters/keys.h"
#include "program/run_context.h"
#include "sliding/transient/dynamics_output.h"
#include "sliding/transient/run_draft.h"
#include "sliding/transient/transient_run.h"

#include <algorithm>
#include <cmath>
#include <ostream>

namespace mesoslip
{
namespace
{
// A million years on a machine of today.
constexpr double largest_step_number = 1e18;

/** Column of the reference node. */
unsigned int reference_node(const ContactParameters &parameters,
                            const UniformGrid<2> &grid)
{
  const double wanted = parameters.observation.reference_x;
  const double x      = std::isnan(wanted) ? 0.5 * grid.extent(0) : wanted;
  return std::lround(std::clamp(x, 0., grid.extent(0)) / grid.spacing[0]);
}

BodySize body_size(const ContactParameters &parameters,
                   const BodyDescription &body,
                   const BodyScales &scales)
{
  const UniformGrid<2> &grid = body.grid;
  BodySize size;
  size.top_area = grid.extent(0);
  size.n_cells  = grid.n_cells();
  size.crossing = scales.crossing();
  size.friction = body.node_friction;
  for (unsigned int i = 0; i <= grid.cells[0]; ++i)
    size.area.push_back(tributary_width(grid, i, parameters.periodic));
  size.n_contact_nodes = grid.cells[0] + (parameters.periodic ? 0 : 1);

  ReferenceNode &node = size.reference;
  node.number         = reference_node(parameters, grid);
  node.position       = {{node.number * grid.spacing[0], 0., 0.}};
  // As of a probe there: a point between two cells belongs to the upper one.
  node.phase =
    static_cast<unsigned int>(body.phase_of(std::min(node.number, grid.cells[0] - 1)));
  node.area = tributary_width(grid, node.number, parameters.periodic);
  return size;
}
} // namespace

TransientAnalysis::TransientAnalysis(const ContactParameters &p, const Keys &keys)
  : BodyAnalysis(p)
  , scales(material)
  , identity(run_identity(
      keys, parameters, "Content of Body/RVE file = " + body.rve_content + "\n"))
{
  const unsigned int n_rows  = body.grid.cells[1] + 1,
                     n_ranks = mpi::n_mpi_processes(MPI_COMM_WORLD),
                     most    = largest_number_of_ranks(n_rows);
  if (n_ranks > most)
    throw UserError(
      "the body has " + std::to_string(n_rows) +
      " rows of nodes (Body/Cells), which are divided among the processes, "
      "two at least each; start " +
      (most == 1 ? "it without mpirun" : "at most " + std::to_string(most) + " of them") +
      " instead of " + std::to_string(n_ranks));
  const double n_steps = largest_number_of_steps(parameters, material);
  if (!(n_steps <= largest_step_number))
    throw UserError("Time/End time: " + to_text(parameters.time.end_time) + " s are " +
                    quantity_text(n_steps, "") +
                    " steps, more than any run can do; are Body/Size in m, the stiffness "
                    "in Pa, the density in kg/m^3 and the times in s?");
  const auto interval = statistics_interval(material, parameters.time.end_time / n_steps);
  check_steady_from(parameters, n_steps, interval);
  needs = needs_of(n_steps, interval);
  require_memory(needs.memory);
}

RunNeeds TransientAnalysis::needs_of(const double n_steps,
                                     const unsigned int interval) const
{
  return run_needs(parameters, scales, n_steps, interval,
                   2. * (body.grid.cells[0] + 1.) * (body.grid.cells[1] + 1.),
                   body.grid.cells[0] + 1.);
}

std::vector<std::string> TransientAnalysis::warnings() const
{
  return implausible_run(parameters, scales,
                         largest_number_of_steps(parameters, material));
}

void TransientAnalysis::describe(std::ostream &out) const
{
  const TimeStepChoice time = choose_time_step(parameters, material);
  const RunNeeds exact =
    needs_of(static_cast<double>(time.n_steps), time.statistics_interval);
  describe_body(out, exact.memory.bytes);
  out.precision(4);
  out << time.text() << "\nTimes: " << crossing_text(parameters, scales) << '\n'
      << exact.text() << bytes_text(exact.disk.bytes) << " on the disk\n";
  for (const std::string &warning : warnings())
    out << "warning: " << warning << '\n';
}

unsigned int TransientAnalysis::useful_ranks() const
{
  // Some seconds of one core; forty rows hide what ranks tell each other.
  constexpr double long_run = 6e8;
  const double n_cells      = double(body.grid.cells[0]) * body.grid.cells[1];
  if (n_cells * largest_number_of_steps(parameters, material) < long_run)
    return 1;
  return std::max(1U, body.grid.cells[1] / 40);
}

void TransientAnalysis::write_draft(const std::string &folder) const
{
  const TimeStepChoice time = choose_time_step(parameters, material);
  on_root(MPI_COMM_WORLD, [&]() {
    const DraftMark mark(false);
    DynamicsFile file = DynamicsFile::create(path_of_draft(folder, "dynamics.h5"), body);
    write_transient_draft(file, parameters, time, nodes_shape(body.grid));
    for (const ProbePoint &probe : parameters.observation.probes)
      {
        const std::array<double, 3> position = place_of_probe(probe, body.grid);
        add_draft_probe(file, probe.name, {position[0], position[1]},
                        parameters.observation.probe_interval, time);
      }
    file.close();
  });
}

void TransientAnalysis::run(RunContext &context)
{
  log_body(context);
  const TimeStepChoice time = [&]() {
    const auto scope = context.timer().scope("Critical time step");
    return choose_time_step(parameters, material);
  }();

  TransientCheckpoint checkpoint(context, parameters.checkpoints,
                                 identity + "Time step in s = " + to_text(time.step.dt) +
                                   "\n");
  const auto found = checkpoint.begin(time.n_steps);
  if (found == TransientCheckpoint::Found::complete)
    return;
  context.log(time.text());
  for (const std::string &warning : warnings())
    context.warn(warning);

  const BodySize size = body_size(parameters, body, scales);
  SlidingGrid sliding(material, run_setup(parameters, size, time), context.communicator(),
                      nullptr, context.options().profile ? &context.timer() : nullptr);
  sliding.set_initial_velocity(parameters.body.initial_velocity);
  const ObservationParameters &observation = parameters.observation;
  GridProbes probes(observation.probes, material, sliding.stepper, sliding.contact,
                    observation.probe_interval);
  DynamicsOutput output(context, parameters, body, time);
  TransientRun<2> run({parameters, time, scales, size, cell_text(body.grid), sliding,
                       observation.probes.empty() ? nullptr : &probes, output, checkpoint,
                       context});
  run.carry_out(found == TransientCheckpoint::Found::state,
                [&]() { summarize_body("transient", context); });
}
} // namespace mesoslip
