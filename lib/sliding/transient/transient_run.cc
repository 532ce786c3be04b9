#include "sliding/transient/transient.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "dynamics/stepper.h"
#include "material/plausibility.h"
#include "observation/grid_probes.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
// Steps: often enough to react to an interruption and to keep few samples waiting, seldom
// enough to cost nothing, and not so few that the stepper could not have several in
// flight. The same whenever the run is resumed, as it may end at a limit cycle only then.
std::uint64_t control_interval(const UniformGrid<2> &grid)
{
  return next_multiple(std::clamp<std::uint64_t>(20000000 / grid.n_cells(), 1, 65536),
                       64);
}

/** Column of the reference contact node M. */
unsigned int reference_node(const ContactParameters &parameters,
                            const UniformGrid<2> &grid)
{
  const double wanted = parameters.observation.reference_x;
  const double x      = std::isnan(wanted) ? 0.5 * grid.extent(0) : wanted;
  return std::lround(std::clamp(x, 0., grid.extent(0)) / grid.spacing[0]);
}

SlidingSetup sliding_setup(const ContactParameters &parameters,
                           const BodyDescription &body,
                           const TimeStepChoice &time)
{
  SlidingSetup setup                 = static_cast<const SlidingSetup &>(parameters);
  setup.step                         = time.step;
  setup.contact.friction_coefficient = body.node_friction;
  setup.steps_per_block =
    std::max<std::uint64_t>(1, time.n_steps / parameters.observation.blocks);
  // The reference node and four more along the contact, for the judgement of the limit
  // cycle.
  setup.monitored_nodes = {reference_node(parameters, body.grid)};
  for (const unsigned int sixth : {1, 2, 4, 5})
    setup.monitored_nodes.push_back(sixth * body.grid.cells[0] / 6);
  return setup;
}

LimitCycleCriterion limit_cycle_criterion(const ContactParameters &parameters,
                                          const UniformGrid<2> &grid)
{
  LimitCycleCriterion criterion = parameters.observation.limit_cycle;
  criterion.reference_power =
    std::fabs(parameters.top.pressure.amplitude() * grid.extent(0) *
              parameters.contact.flat_velocity.amplitude());
  return criterion;
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
  , material(material)
  , checkpoint(checkpoint)
  , output(output)
  , context(context)
  , body(material,
         sliding_setup(parameters, description, time),
         context.communicator(),
         nullptr,
         context.options().profile ? &context.timer() : nullptr)
  , recent_contact(time.statistics_interval, body.setup.monitored_nodes, time.step)
  , recent_top(time.statistics_interval)
  , monitor(
      body.stepper,
      [this]() { return body.boundary_work(); },
      [this](const Runaway &found, const std::uint64_t n) {
        report_runaway(found, n, this->time, this->parameters);
      })
  , strains(body.stepper,
            [this](const Deformation &found, const std::uint64_t n) { judge(found, n); })
  , limit_cycle(limit_cycle_criterion(parameters, description.grid),
                material.n_columns() - (parameters.periodic ? 1 : 0),
                parameters.energy_interval,
                context.communicator())
  , statistics(time.statistics_interval, time.step.dt, parameters.contact.flat_velocity)
{
  body.contact.observe(recent_contact);
  body.top.observe(recent_top);
  set_initial_velocity();
  const ObservationParameters &observation = parameters.observation;
  if (!observation.probes.empty())
    probes = std::make_unique<GridProbes>(observation.probes, material, body.stepper,
                                          body.contact, observation.probe_interval);
}

void TransientRun::set_initial_velocity()
{
  const NodeRows &rows             = body.rows;
  NodalField<double> &w            = body.w;
  const std::array<bool, 2> &left  = parameters.sides.left_held,
                            &right = parameters.sides.right_held;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      {
        std::fill_n(w.row(c, j), w.n_columns(), parameters.body.initial_velocity[c]);
        if (left[c])
          w.row(c, j)[0] = 0.;
        if (right[c])
          w.row(c, j)[w.n_columns() - 1] = 0.;
      }
  // What the top holds does not move from the start.
  const bool held[] = {transmits_tangential_force(parameters.top),
                       parameters.top.kind == TopSetup::Kind::held};
  if (rows.end == rows.n_global)
    for (unsigned int c = 0; c < 2; ++c)
      if (held[c])
        std::fill_n(w.row(c, rows.local(rows.n_global - 1)), w.n_columns(), 0.);
}

void TransientRun::judge(const Deformation &found, const std::uint64_t n)
{
  require_upright_cells(found, n, time, parameters, material);
  const std::string warning = large_strain_warning(
    found, parameters, material,
    " in step " + std::to_string(n) + " at t = " + quantity_text(n * time.step.dt, "s"));
  if (!warning.empty() && !warned)
    context.warn(warning);
  warned = warned || !warning.empty();
}

TransientRun::Request TransientRun::request(const std::uint64_t n)
{
  const ContactHistory fresh = recent_contact.take();
  statistics.add(fresh);
  statistics.add(recent_top.take());
  if (!limit_cycle.update(fresh, body.energy.get()))
    return Request::look;
  const bool reached =
    parameters.observation.stop_at_limit_cycle && limit_cycle.reached();
  if (reached || n >= time.n_steps)
    return Request::end;
  if (context.stop_requested_here())
    return Request::stop;
  return context.root() && checkpoint.due() ? Request::save : Request::go_on;
}

bool TransientRun::control(const std::uint64_t n)
{
  const Request wanted = [&]() {
    const auto scope = context.timer().scope("Limit cycle, requests");
    Request largest  = request(n);
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, context.communicator());
    if (largest == Request::look)
      monitor.check(n);
    context.progress().update(n, n * time.step.dt);
    return largest;
  }();
  interrupted    = wanted == Request::stop;
  at_limit_cycle = wanted == Request::end && n < time.n_steps;
  if (wanted == Request::save || wanted == Request::stop)
    save();
  return wanted < Request::stop;
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
  if (output.has_snapshots())
    {
      output.begin_snapshots(body.stepper, checkpoint.position().snapshots);
      observe_with(output, "Snapshots");
      monitor.guard(output);
    }

  context.progress().start("Sliding", time.n_steps, description.grid.n_cells(),
                           body.stepper.step_number());
  counted = std::chrono::steady_clock::now();
  if (!at_limit_cycle)
    {
      const auto scope = context.timer().scope("Time loop");
      run_time_loop(
        body.stepper, observers, time.n_steps, control_interval(description.grid),
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
  // Of the rank that has the top.
  const auto of_top = [this](auto object) {
    broadcast_object(context.communicator(), object, context.n_ranks() - 1);
    return object;
  };
  TransientResult all{parameters, description, time};
  body.node_statistics.finish(body.contact);
  strains.look(body.stepper.step_number());
  all.largest_strain = strains.largest_strain();
  // Before it was resumed, as each run has its own warnings.
  if (!warned && !(all.largest_strain <= largest_small_strain))
    context.warn("the strain was " + quantity_text(100. * all.largest_strain, "%") +
                 " earlier in the run, beyond small strains: its results cannot be "
                 "trusted");
  all.history = body.contact_recorder.history();
  all.blocks  = body.node_statistics.blocks();
  all.top     = of_top(body.top_recorder.history());
  all.series  = statistics.series();
  // Where the top takes no tangential forces, they are those of the contact.
  const std::vector<double> at_the_top = of_top(statistics.top_friction());
  if (transmits_tangential_force(parameters.top))
    all.series.apparent_friction = at_the_top;
  if (body.energy)
    all.energy = body.energy->reduce();
  if (probes)
    all.probes = probes->gather();
  all.steps_done     = body.stepper.step_number();
  all.reference_node = reference_node(parameters, description.grid);
  all.loop_seconds   = loop_seconds;
  all.interrupted    = interrupted;
  all.kernel         = body.stepper.kernel_name();

  const double given      = parameters.observation.steady_from;
  all.limit_cycle_reached = limit_cycle.reached();
  all.steady_from         = std::isnan(given) ? limit_cycle.steady_from() : given;
  all.limit_cycle         = limit_cycle.description();
  if (!limit_cycle.reached() || !std::isnan(given)) // it says when a limit cycle begins
    all.limit_cycle += brief_text(4, ", statistics from ", all.steady_from, " s on");
  return all;
}
} // namespace mesoslip
