#include "sliding/transient/transient.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "dynamics/stepper.h"
#include "material/plausibility.h"
#include "observation/grid_probes.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace mesoslip
{
namespace
{
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

SlidingSetup sliding_setup(const ContactParameters &parameters,
                           const BodyDescription &body,
                           const BodySize &size,
                           const TimeStepChoice &time)
{
  SlidingSetup setup                 = static_cast<const SlidingSetup &>(parameters);
  setup.step                         = time.step;
  setup.contact.friction_coefficient = body.node_friction;
  setup.steps_per_block =
    std::max<std::uint64_t>(1, time.n_steps / parameters.observation.blocks);
  setup.monitored_nodes = monitored_nodes(size.reference.number, body.grid.cells[0]);
  setup.node_loads      = parameters.wants_node_loads();
  setup.contact_map     = contact_map_setup(parameters, time.step.dt);
  return setup;
}
} // namespace

TransientRun::TransientRun(const ContactParameters &parameters,
                           const BodyDescription &description,
                           const TimeStepChoice &time,
                           const UniformMaterial &material,
                           TransientCheckpoint &checkpoint,
                           DynamicsOutput &output,
                           RunContext &context)
  : parameters(parameters)
  , description(description)
  , time(time)
  , scales(material)
  , place(cell_text(material.grid()))
  , checkpoint(checkpoint)
  , output(output)
  , context(context)
  , size(body_size(parameters, description, scales))
  , body(material,
         sliding_setup(parameters, description, size, time),
         context.communicator(),
         nullptr,
         context.options().profile ? &context.timer() : nullptr)
  , monitor(
      body.stepper,
      [this]() { return body.boundary_work(); },
      [this](const Runaway &found, const std::uint64_t n) {
        report_runaway(found, n, this->time, this->parameters);
      })
  , strains(body.stepper,
            [this](const Deformation &found, const std::uint64_t n) { judge(found, n); })
  , statistics(parameters, size, time, body, checkpoint, context)
{
  set_initial_velocity();
  const ObservationParameters &observation = parameters.observation;
  if (!observation.probes.empty())
    probes = std::make_unique<GridProbes>(observation.probes, material, body.stepper,
                                          body.contact, observation.probe_interval);
  if (body.setup.contact_map.interval == 0)
    return;
  std::vector<unsigned int> nodes(context.root() ? size.n_contact_nodes : 0);
  std::iota(nodes.begin(), nodes.end(), 0U);
  map = std::make_unique<ContactMapOutput<2>>(body.setup.contact_map, body.contact_map,
                                              nodes, size, context.communicator());
}

// The scheme has velocities of beta2 dt before, see ExplicitStepper.
void TransientRun::set_initial_velocity()
{
  const NodeRows &rows  = body.rows;
  NodalField<double> &w = body.w;
  const unsigned int n = w.n_columns(), last = rows.n_global - 1;
  const double back                = -time.step.beta2 * time.step.dt;
  const std::array<double, 3> &v   = parameters.body.initial_velocity;
  const std::array<bool, 2> &left  = parameters.sides.left_held,
                            &right = parameters.sides.right_held;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      std::fill_n(w.row(c, j), n, v[c] + back * time.step.acceleration[c]);
  for (unsigned int i = 0; rows.begin == 0 && i < n; ++i)
    if (body.contact.rests(i, time.step.acceleration[1]))
      w.row(1, rows.local(0))[i] = v[1];
  if (rows.end == rows.n_global)
    {
      std::vector<double> mass(n);
      body.stepper.mass_row(last, mass.data());
      if (left[1])
        mass.front() = 0.;
      if (right[1])
        mass.back() = 0.;
      const std::vector<double> a = body.top.start_acceleration(mass);
      for (unsigned int i = 0; i < n; ++i)
        w.row(1, rows.local(last))[i] = v[1] + back * a[i];
    }
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      {
        if (left[c])
          w.row(c, j)[0] = 0.;
        if (right[c])
          w.row(c, j)[n - 1] = 0.;
      }
  // What the top holds does not move from the start.
  const bool held[] = {transmits_tangential_force(parameters.top),
                       parameters.top.kind == TopSetup::Kind::held};
  if (rows.end == rows.n_global)
    for (unsigned int c = 0; c < 2; ++c)
      if (held[c])
        std::fill_n(w.row(c, rows.local(last)), n, 0.);
}

void TransientRun::judge(const Deformation &found, const std::uint64_t n)
{
  require_upright_cells(found, n, time, parameters, scales, place);
  const std::string warning = large_strain_warning(
    found, parameters, scales, place,
    " in step " + std::to_string(n) + " at t = " + quantity_text(n * time.step.dt, "s"));
  if (!warning.empty() && !warned)
    context.warn(warning);
  warned = warned || !warning.empty();
}

bool TransientRun::control(const std::uint64_t n)
{
  const RunRequest wanted = statistics.request(n, body.energy.get());
  if (wanted == RunRequest::look)
    monitor.check(n);
  context.progress().update(n, n * time.step.dt);
  interrupted    = wanted == RunRequest::stop;
  at_limit_cycle = wanted == RunRequest::end && n < time.n_steps;
  if (wanted == RunRequest::save || wanted == RunRequest::stop)
    save();
  return wanted < RunRequest::stop;
}

CheckpointPosition TransientRun::position() const
{
  CheckpointPosition p;
  p.step           = body.stepper.step_number();
  p.time           = p.step * time.step.dt;
  p.by_limit_cycle = at_limit_cycle;
  p.at_end         = at_limit_cycle || p.step == time.n_steps;
  return p;
}

void TransientRun::count_time()
{
  const auto now = std::chrono::steady_clock::now();
  loop_seconds += std::chrono::duration<double>(now - counted).count();
  counted = now;
}

void TransientRun::save()
{
  count_time();
  if (map)
    map->drain(body.stepper.step_number());
  CheckpointPosition position = this->position();
  on_root(context.communicator(),
          [&]() { position.snapshots = output.save_snapshots(); });
  checkpoint.write(position, save_state(*this));
}

void TransientRun::restore()
{
  checkpoint.restore(*this);
  at_limit_cycle = checkpoint.position().by_limit_cycle;
  context.log("Resumed at step " + std::to_string(body.stepper.step_number()) +
              ", t = " + to_text(body.stepper.step_number() * time.step.dt) + " s");
}

TransientResult TransientRun::run()
{
  std::vector<StepObserver *> observers;
  const auto observe_with = [&](StepObserver &observer, const char *name) {
    observers.push_back(body.profile.timed<TimedObserver>(observer, name));
  };
  observe_with(monitor, "Stability monitor");
  observe_with(strains, "Strains");
  if (body.energy)
    observe_with(*body.energy, "Energies");
  if (probes)
    observe_with(*probes, "Probes");
  output.begin(body.stepper, checkpoint.position().snapshots, map.get());
  if (output.has_snapshots())
    {
      observe_with(output, "Snapshots");
      monitor.guard(output);
    }
  if (map)
    {
      observe_with(*map, "Map of the contact");
      monitor.guard(*map);
    }

  context.progress().start("Sliding", time.n_steps, description.grid.n_cells(),
                           body.stepper.step_number());
  counted = std::chrono::steady_clock::now();
  if (!at_limit_cycle)
    {
      const auto scope = context.timer().scope("Time loop");
      run_time_loop(
        body.stepper, observers, time.n_steps, control_interval(size.n_cells),
        [this](const std::uint64_t n) { return control(n); }, body.profile.timer);
      monitor.check(body.stepper.step_number());
    }
  context.progress().finish();
  if (!interrupted && parameters.checkpoints.keep)
    save();
  count_time();
  return collect();
}

TransientResult TransientRun::collect()
{
  TransientResult all{parameters, size, time};
  statistics.collect(all);
  if (map)
    map->drain(body.stepper.step_number());
  strains.look(body.stepper.step_number());
  all.largest_strain = strains.largest_strain();
  // Before it was resumed, as each run has its own warnings.
  if (!warned && !(all.largest_strain <= largest_small_strain))
    context.warn("the strain was " + quantity_text(100. * all.largest_strain, "%") +
                 " earlier in the run, beyond small strains: its results cannot be "
                 "trusted");
  if (body.energy)
    all.energy = body.energy->reduce();
  if (probes)
    all.probes = probes->gather();
  all.steps_done   = body.stepper.step_number();
  all.loop_seconds = loop_seconds;
  all.interrupted  = interrupted;
  all.kernel       = body.stepper.kernel_name();

  return all;
}
} // namespace mesoslip
