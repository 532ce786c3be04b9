#include "simulation/transient.h"

#include "dynamics/stability_monitor.h"
#include "dynamics/time_loop.h"
#include "elasticity/row_partition.h"
#include "elasticity/uniform_grid_operator.h"
#include "io/errors.h"
#include "io/hdf5_file.h"
#include "io/parameters.h"
#include "io/run_context.h"
#include "observation/contact_shares.h"
#include "observation/snapshot_recorder.h"
#include "observation/steady_state.h"
#include "simulation/dynamics_file.h"
#include "simulation/runaway_report.h"
#include "simulation/transient_summary.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
// Often enough to react to an interruption, seldom enough to cost nothing.
std::uint64_t
control_interval(const UniformGrid<2> &grid)
{
  return std::max<std::uint64_t>(1, 20000000 / grid.n_cells());
}

/** One run: the body, its boundaries and its observers. */
class Transient
{
public:
  Transient(const ContactParameters &parameters,
            const Scene             &scene,
            const TimeStepChoice    &time,
            const UniformMaterial   &material,
            RunContext              &context);

  TransientObservations
  run(SnapshotRecorder::Writer write_snapshot);

private:
  ContactSetup
  contact_setup() const;
  TopSetup
  top_setup() const;
  LimitCycleCriterion
  criterion() const;
  unsigned int
  reference_node() const;
  std::vector<ProbeRecorder::Point>
  probe_points() const;
  BoundaryWork
  boundary_work() const;
  std::array<double, 2>
  traction(const unsigned int node) const;
  void
  set_initial_velocity();
  bool
  control(const std::uint64_t n);
  std::vector<unsigned int>
  monitored_nodes() const;
  void
  gather_energies();
  void
  feed_detector();
  TopHistory
  gather_top() const;
  TransientObservations
  collect();

  const ContactParameters &parameters;
  const Scene             &scene;
  const TimeStepChoice    &time;
  const UniformMaterial   &material;
  RunContext              &context;
  const NodeRows           rows;
  NodalField<double>       u, w;
  ContactRow               contact;
  TopRow                   top;
  MPIHalo                  halo;
  ExplicitStepper          stepper;
  UniformGridOperator      op;
  StabilityMonitor         monitor;
  LimitCycleDetector       detector;
  std::size_t              samples_fed = 0;
  std::vector<double>      kinetic_energy, elastic_energy; ///< of all ranks, samples so far
  bool                     interrupted = false;
  double                   loop_seconds = 0.;

  std::unique_ptr<EnergyAudit>   energy;
  std::unique_ptr<ProbeRecorder> probes;
};

SweepOptions
sweep_options(const ContactParameters &parameters)
{
  SweepOptions options;
  options.wavefront = parameters.wavefront;
  if (parameters.instruction_set != "auto")
    for (const InstructionSet isa :
         {InstructionSet::x86_64, InstructionSet::x86_64_v3, InstructionSet::x86_64_v4})
      if (to_string(isa) == parameters.instruction_set)
        options.isa = isa;
  return options;
}

Transient::Transient(const ContactParameters &parameters,
                     const Scene             &scene,
                     const TimeStepChoice    &time,
                     const UniformMaterial   &material,
                     RunContext              &context)
  : parameters(parameters)
  , scene(scene)
  , time(time)
  , material(material)
  , context(context)
  , rows(partition_rows(material.n_rows(), context.communicator()))
  , u(material.n_columns(), rows.n_local())
  , w(material.n_columns(), rows.n_local())
  , contact(contact_setup(), time.step)
  , top(top_setup(), time.step, material.n_columns())
  , halo(material.n_columns(), context.communicator())
  , stepper(material,
            rows,
            time.step,
            parameters.sides,
            u,
            w,
            &contact,
            &top,
            context.n_ranks() > 1 ? &halo : nullptr,
            sweep_options(parameters))
  , op(material, rows)
  , monitor(
      op,
      time.step,
      u,
      w,
      [this]() { return boundary_work(); },
      [this](const Runaway &found, const std::uint64_t n) {
        report_runaway(found, n, this->time, this->parameters);
      },
      context.communicator())
  , detector(criterion())
{
  set_initial_velocity();
  const ObservationParameters &observation = parameters.observation;
  if (observation.energy_interval > 0)
    energy = std::make_unique<EnergyAudit>(op,
                                           time.step,
                                           u,
                                           w,
                                           parameters.top.platen_mass,
                                           observation.energy_interval,
                                           [this]() { return boundary_work(); },
                                           context.communicator());
  if (!observation.probes.empty())
    probes = std::make_unique<ProbeRecorder>(
      probe_points(),
      material,
      rows,
      time.step,
      u,
      w,
      observation.probe_interval,
      [this](const unsigned int node) { return traction(node); },
      context.communicator());
}

unsigned int
Transient::reference_node() const
{
  const double wanted = parameters.observation.reference_x;
  const double x      = std::isnan(wanted) ? 0.5 * scene.grid.extent(0) : wanted;
  return std::lround(std::clamp(x, 0., scene.grid.extent(0)) / scene.grid.spacing[0]);
}

ContactSetup
Transient::contact_setup() const
{
  ContactSetup setup;
  setup.law                  = parameters.friction.law;
  setup.friction_coefficient = scene.node_friction;
  setup.flat_velocity        = parameters.friction.flat_velocity;
  setup.gap                  = parameters.friction.gap;
  setup.periodic             = parameters.periodic;
  setup.history_interval     = parameters.observation.history_interval;
  setup.steps_per_block =
    std::max<std::uint64_t>(1, time.n_steps / parameters.observation.blocks);
  setup.monitored_nodes = monitored_nodes();
  return setup;
}

TopSetup
Transient::top_setup() const
{
  TopSetup setup         = parameters.top;
  setup.cell_width       = scene.grid.spacing[0];
  setup.periodic         = parameters.periodic;
  setup.history_interval = parameters.observation.history_interval;
  return setup;
}

LimitCycleCriterion
Transient::criterion() const
{
  LimitCycleCriterion c;
  c.periods   = parameters.observation.limit_cycle_periods;
  c.windows   = parameters.observation.limit_cycle_windows;
  c.tolerance = parameters.observation.limit_cycle_tolerance;
  c.reference_power =
    std::fabs(parameters.top.pressure.amplitude() * scene.grid.extent(0) *
              parameters.friction.flat_velocity.amplitude());
  return c;
}

std::vector<ProbeRecorder::Point>
Transient::probe_points() const
{
  std::vector<ProbeRecorder::Point> points;
  for (const ProbeParameters &probe : parameters.observation.probes)
    {
      ProbeRecorder::Point point{probe.name, probe.position};
      if (probe.nearest_node)
        for (unsigned int d = 0; d < 2; ++d)
          point.position[d] =
            std::round(point.position[d] / scene.grid.spacing[d]) * scene.grid.spacing[d];
      points.push_back(point);
    }
  return points;
}

BoundaryWork
Transient::boundary_work() const
{
  return {top.work() + contact.work().flat, contact.work().friction, contact.work().impact};
}

std::array<double, 2>
Transient::traction(const unsigned int node) const
{
  const bool   end = !parameters.periodic && (node == 0 || node + 1 == material.n_columns());
  const double width = scene.grid.spacing[0] * (end ? 0.5 : 1.);
  return {{contact.tangential_force()[node] / width, contact.normal_force()[node] / width}};
}

void
Transient::set_initial_velocity()
{
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < rows.n_local(); ++j)
      std::fill_n(w.row(c, j), w.n_columns(), parameters.body.initial_velocity[c]);
  const auto hold = [&](const std::array<bool, 2> &held, const unsigned int column) {
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; held[c] && j < rows.n_local(); ++j)
        w.row(c, j)[column] = 0.;
  };
  hold(parameters.sides.left_held, 0);
  hold(parameters.sides.right_held, w.n_columns() - 1);
  // What the top holds does not move from the start.
  const TopSetup::Kind kind = parameters.top.kind;
  const bool held_x = kind != TopSetup::Kind::pressure || parameters.top.lateral_held;
  if (rows.end == rows.n_global)
    for (unsigned int c = 0; c < 2; ++c)
      if (c == 0 ? held_x : kind == TopSetup::Kind::held)
        std::fill_n(w.row(c, rows.local(rows.n_global - 1)), w.n_columns(), 0.);
}

// The reference node and four more along the contact, for the judgement of the limit cycle.
std::vector<unsigned int>
Transient::monitored_nodes() const
{
  std::vector<unsigned int> nodes = {reference_node()};
  for (const unsigned int sixth : {1, 2, 4, 5})
    nodes.push_back(sixth * scene.grid.cells[0] / 6);
  return nodes;
}

// Collective.
void
Transient::gather_energies()
{
  if (!energy)
    return;
  const EnergyHistory &local = energy->local_history();
  const auto           sum   = [&](const std::vector<double> &part, std::vector<double> &all) {
    const std::size_t known = all.size();
    all.insert(all.end(), part.begin() + known, part.end());
    MPI_Allreduce(MPI_IN_PLACE,
                  all.data() + known,
                  all.size() - known,
                  MPI_DOUBLE,
                  MPI_SUM,
                  context.communicator());
  };
  sum(local.kinetic, kinetic_energy);
  sum(local.elastic, elastic_energy);
}

void
Transient::feed_detector()
{
  const ContactHistory &h       = contact.history();
  const double          n_nodes = material.n_columns() - (parameters.periodic ? 1 : 0);
  CycleSample           sample;
  sample.displacement.resize(h.nodes.size());
  for (; samples_fed < h.time.size(); ++samples_fed)
    {
      const std::size_t k = samples_fed;
      for (std::size_t node = 0; node < h.nodes.size(); ++node)
        sample.displacement[node] = h.nodes[node].ux[k];
      sample.time             = h.time[k];
      sample.friction_energy  = h.friction_energy[k];
      sample.normal_force     = h.normal_force[k];
      sample.tangential_force = h.tangential_force[k];
      sample.sticking         = h.sticking[k] / n_nodes;
      sample.slipping         = h.slipping[k] / n_nodes;
      if (energy) // the last one known at that step
        {
          const std::size_t e   = h.step[k] / parameters.observation.energy_interval;
          sample.kinetic_energy = kinetic_energy[e];
          sample.elastic_energy = elastic_energy[e];
        }
      detector.add(sample);
    }
}

bool
Transient::control(const std::uint64_t n)
{
  gather_energies();
  int stop = 0;
  if (rows.begin == 0)
    {
      feed_detector();
      stop = parameters.observation.stop_at_limit_cycle && detector.reached();
    }
  MPI_Bcast(&stop, 1, MPI_INT, 0, context.communicator());
  interrupted = context.stop_requested();
  context.progress().update(n, n * time.step.dt);
  return stop == 0 && !interrupted;
}

TransientObservations
Transient::run(SnapshotRecorder::Writer write_snapshot)
{
  const ObservationParameters &o = parameters.observation;
  std::vector<StepObserver *>  observers = {&monitor};
  if (energy)
    observers.push_back(energy.get());
  if (probes)
    observers.push_back(probes.get());
  std::unique_ptr<SnapshotRecorder> snapshots;
  if (o.snapshots_interval > 0.)
    {
      const double end = parameters.time.end_time;
      snapshots        = std::make_unique<SnapshotRecorder>(
        o.snapshots_from,
        std::isnan(o.snapshots_to) ? end - time.step.dt : o.snapshots_to,
        o.snapshots_interval,
        time.step.dt,
        u,
        rows,
        context.communicator(),
        write_snapshot);
      observers.push_back(snapshots.get());
      monitor.guard(*snapshots);
    }

  context.progress().start("Sliding", time.n_steps, scene.grid.n_cells());
  const auto start = std::chrono::steady_clock::now();
  {
    const auto scope = context.timer().scope("Time loop");
    run_time_loop(stepper,
                  observers,
                  time.n_steps,
                  control_interval(scene.grid),
                  [this](const std::uint64_t n) { return control(n); });
    monitor.check(stepper.step_number());
  }
  loop_seconds =
    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  context.progress().finish();
  return collect();
}

TopHistory
Transient::gather_top() const
{
  TopHistory history = top.history();
  const int  last    = context.n_ranks() - 1;
  if (last == 0)
    return history;
  for (auto *values :
       {&history.normal_force, &history.tangential_force, &history.displacement, &history.work})
    {
      unsigned long n = values->size();
      MPI_Bcast(&n, 1, MPI_UNSIGNED_LONG, last, context.communicator());
      values->resize(n);
      MPI_Bcast(values->data(), n, MPI_DOUBLE, last, context.communicator());
    }
  return history;
}

TransientObservations
Transient::collect()
{
  TransientObservations all;
  contact.finish();
  all.contact = contact.history();
  all.blocks  = contact.blocks();
  all.top     = gather_top();
  if (energy)
    all.energy = energy->reduce();
  if (probes)
    all.probes = probes->gather();
  all.steps_done          = stepper.step_number();
  all.dt                  = time.step.dt;
  all.reference_node      = reference_node();
  all.loop_seconds        = loop_seconds;
  all.interrupted         = interrupted;
  all.kernel              = stepper.kernel_name();
  all.limit_cycle_reached = detector.reached();
  all.limit_cycle         = detector.description();
  const double given      = parameters.observation.steady_from;
  all.steady_from         = std::isnan(given) ? detector.steady_from() : given;
  all.period              = detector.period();
  return all;
}
} // namespace

void
run_transient(const ContactParameters &parameters, const Scene &scene, RunContext &context)
{
  const UniformMaterial material = scene.make_material(parameters.periodic);
  const TimeStepChoice  time     = [&]() {
    const auto scope = context.timer().scope("Critical time step");
    return choose_time_step(parameters, material);
  }();
  context.log(time.text());

  Transient   run(parameters, scene, time, material, context);
  DynamicsFile file(context, parameters, scene);
  const TransientObservations observed =
    run.run([&](const std::uint64_t, const double t, const NodalField<double> &u) {
      const auto scope = context.timer().scope("Snapshots");
      file.add_snapshot(t, u);
    });

  const auto             scope   = context.timer().scope("Evaluation and output");
  if (context.root())
    {
      const TransientSummary summary = summarize_transient(parameters, scene, observed);
      file.write(observed, summary);
      write_summary(parameters, scene, time, observed, summary, context);
    }
  if (observed.interrupted && context.root())
    context.write_summary();
  if (observed.interrupted)
    throw Interrupted("stopped on request after step " + std::to_string(observed.steps_done) +
                      "; what was observed so far is in " + context.output_folder());
}
} // namespace mesoslip
