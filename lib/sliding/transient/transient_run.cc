#include "sliding/transient/transient_run.h"

#include "base/exchange.h"
#include "dynamics/stepper.h"
#include "material/plausibility.h"
#include "parameters/parameters.h"
#include "program/run_context.h"
#include "sliding/transient/failure_report.h"

#include <algorithm>
#include <cmath>
#include <sstream>

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

// With the begin of the statistics unless it is that of the limit cycle, which is in the
// description.
std::string limit_cycle_text(const LimitCycleDetector &detector,
                             const double given,
                             const double from)
{
  std::ostringstream text;
  text.precision(4);
  text << detector.description();
  if (!detector.reached() || !std::isnan(given))
    text << ", statistics from " << from << " s on";
  return text.str();
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
    probes = std::make_unique<ProbeRecorder>(
      probe_points(), material, body.rows, time.step, body.u, body.w, body.contact,
      observation.probe_interval, context.communicator());
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

bool TransientRun::observe()
{
  const ContactHistory fresh = recent_contact.take();
  statistics.add(fresh);
  statistics.add(recent_top.take());
  return limit_cycle.update(fresh, body.energy.get());
}

TransientRun::Request TransientRun::request(const std::uint64_t n)
{
  if (!observe())
    return Request::look;
  const bool reached =
    parameters.observation.stop_at_limit_cycle && limit_cycle.detector().reached();
  if (reached || n >= time.n_steps)
    return Request::end;
  if (context.stop_requested_here())
    return Request::stop;
  return context.root() && checkpoint.due() ? Request::save : Request::go_on;
}

TransientRun::Request TransientRun::request_of_all(const std::uint64_t n)
{
  const auto scope = context.timer().scope("Limit cycle, requests");
  Request wanted   = request(n);
  MPI_Allreduce(MPI_IN_PLACE, &wanted, 1, MPI_INT, MPI_MAX, context.communicator());
  if (wanted == Request::look)
    monitor.check(n);
  context.progress().update(n, n * time.step.dt);
  return wanted;
}

bool TransientRun::control(const std::uint64_t n)
{
  const Request wanted = request_of_all(n);
  interrupted          = wanted == Request::stop;
  at_limit_cycle       = wanted == Request::end && n < time.n_steps;
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

void TransientRun::save()
{
  const auto now = std::chrono::steady_clock::now();
  loop_seconds += std::chrono::duration<double>(now - counted).count();
  counted                     = now;
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

std::unique_ptr<SnapshotRecorder> TransientRun::make_snapshots()
{
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return nullptr;
  // Beyond the last step there is none to be seen.
  return std::make_unique<SnapshotRecorder>(
    o.snapshots_from,
    std::isnan(o.snapshots_to)
      ? parameters.time.end_time
      : std::min(o.snapshots_to, (time.n_steps + 1) * time.step.dt),
    o.snapshots_interval, time.step.dt, body.u, body.rows, context.communicator(),
    [this](const NodalField<double> &whole) {
      const auto scope = context.timer().scope("Writing snapshots");
      output.add_snapshot(whole);
    });
}

TransientObservations TransientRun::run()
{
  std::vector<StepObserver *> observers = {
    body.profile.timed(monitor, "Stability monitor"),
    body.profile.timed(strains, "Strains")};
  if (body.energy)
    observers.push_back(body.profile.timed(*body.energy, "Energies"));
  if (probes)
    observers.push_back(body.profile.timed(*probes, "Probes"));
  const std::unique_ptr<SnapshotRecorder> snapshots = make_snapshots();
  if (snapshots)
    {
      on_root(context.communicator(), [&]() {
        output.begin_snapshots(snapshots->times(), checkpoint.position().snapshots);
      });
      observers.push_back(body.profile.timed(*snapshots, "Snapshots"));
      monitor.guard(*snapshots);
    }

  context.progress().start("Sliding", time.n_steps, description.grid.n_cells(),
                           body.stepper.step_number());
  counted = std::chrono::steady_clock::now();
  if (!at_limit_cycle)
    {
      const auto scope = context.timer().scope("Time loop");
      run_time_loop(
        body.stepper, observers, time.n_steps, control_interval(description.grid),
        [this](const std::uint64_t n) { return control(n); }, body.profile.timer());
      monitor.check(body.stepper.step_number());
    }
  context.progress().finish();
  if (!interrupted && parameters.checkpoints.keep)
    save();
  loop_seconds +=
    std::chrono::duration<double>(std::chrono::steady_clock::now() - counted).count();
  return collect();
}

template <class T>
T TransientRun::of_top(T object) const
{
  broadcast_object(context.communicator(), object, context.n_ranks() - 1);
  return object;
}

TransientObservations TransientRun::collect()
{
  TransientObservations all;
  body.node_statistics.finish(body.contact);
  strains.look(body.stepper.step_number());
  all.largest_strain = strains.largest_strain();
  // Before it was resumed, as each run has its own warnings.
  if (!warned && !(all.largest_strain <= largest_small_strain))
    context.warn("the strain was " + quantity_text(100. * all.largest_strain, "%") +
                 " earlier in the run, beyond small strains: its results cannot be "
                 "trusted");
  all.contact = body.contact_recorder.history();
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
  all.steps_done                     = body.stepper.step_number();
  all.dt                             = time.step.dt;
  all.reference_node                 = reference_node(parameters, description.grid);
  all.loop_seconds                   = loop_seconds;
  all.interrupted                    = interrupted;
  all.kernel                         = body.stepper.kernel_name();
  const LimitCycleDetector &detector = limit_cycle.detector();
  all.limit_cycle_reached            = detector.reached();
  const double given                 = parameters.observation.steady_from;
  all.steady_from                    = std::isnan(given) ? detector.steady_from() : given;
  all.limit_cycle                    = limit_cycle_text(detector, given, all.steady_from);
  return all;
}
} // namespace mesoslip
