#include "sliding/transient/transient_run.h"
#include "sliding/transient/result_file.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "base/version.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "program/run_context.h"
#include "sliding/sweep/run_end.h"

#include <algorithm>

namespace mesoslip
{
namespace
{
/** @throws UserError for a run that single precision spoils, once its strains are known */
void require_precision(const LargestStrain &so_far,
                       const std::uint64_t n,
                       const TimeStepChoice &time)
{
  constexpr double harmful = 1e-2; // energies are off by several percent then
  if (2 * n >= time.n_steps && so_far.rounding > harmful * so_far.strain)
    throw UserError(brief_text(
      2, "Time/Precision is single, but rounding takes up to ", so_far.rounding,
      " of strains up to ", so_far.strain, " by t = ", n * time.step.dt,
      " s, as nodes are far from where they started; set Time/Precision = double"));
}
} // namespace

std::string run_identity(const Keys &keys,
                         const ContactParameters &parameters,
                         const std::string &contents)
{
  return canonical_parameters(keys, {"Output folder", "Time/End time",
                                     "Observation/Steady from", "Checkpoints/",
                                     "Performance/", "Modal/", "Static contact/",
                                     "Friction homogenization/", "Sweep/"}) +
         "Performance/Instruction set = " + to_string(resolve(parameters.sweep.isa)) +
         "\n" + contents +
         "Coefficient law = " + parameters.friction.coefficient_law.text() +
         "\nProgram version = " + version + "\n";
}

SlidingSetup run_setup(const ContactParameters &parameters,
                       const BodySize &size,
                       const TimeStepChoice &time)
{
  SlidingSetup setup                 = static_cast<const SlidingSetup &>(parameters);
  setup.step                         = time.step;
  setup.history_interval             = time.interval(parameters.history_interval);
  setup.probe_interval               = time.interval(parameters.probe_interval);
  setup.contact.friction_coefficient = size.friction;
  setup.steps_per_block =
    std::max<std::uint64_t>(1, time.n_steps / parameters.observation.blocks);
  setup.monitored_nodes = monitored_nodes(
    size.reference.number, static_cast<unsigned int>(size.friction.size()) - 1);
  setup.node_loads  = parameters.wants_node_loads();
  setup.contact_map = contact_map_setup(parameters, time.step.dt);
  return setup;
}

SlidingSetup setup_below(const ContactParameters &parameters,
                         const BodySize &size,
                         const StepParameters &step,
                         const unsigned int probe_interval)
{
  SlidingSetup setup                 = static_cast<const SlidingSetup &>(parameters);
  setup.step.dt                      = step.dt;
  setup.history_interval             = 0;
  setup.probe_interval               = probe_interval;
  setup.contact.friction_coefficient = size.friction;
  return setup;
}

template <int dim>
TransientRun<dim>::TransientRun(const RunParts<dim> &parts)
  : parts(parts)
  , stepper(parts.body.time_integration())
  , monitor(
      stepper,
      [this]() { return this->parts.body.boundary_work(); },
      [this](const Runaway &found, const std::uint64_t n) {
        report_runaway(found, n, this->parts.time, this->parts.parameters,
                       stepper.rows.n_global > 1);
      })
  , strains(stepper,
            [this](const Deformation &found, const std::uint64_t n) {
              judge(found, this->parts.place, n);
              require_precision(strains.so_far(), n, this->parts.time);
              judge_counter(n);
            })
  , statistics(parts.parameters,
               parts.size,
               parts.time,
               parts.body,
               parts.checkpoint,
               parts.context)
{
  if (const SlidingSetup &setup = parts.body.setup; setup.contact_map.interval > 0)
    map = std::make_unique<ContactMapOutput<dim>>(
      setup.contact_map, parts.body.contact_map, setup.contact_places, parts.size,
      parts.context.communicator());
}

template <int dim>
void TransientRun<dim>::judge_counter(const std::uint64_t n)
{
  if (!parts.parameters.counter)
    return;
  const Deformation own   = parts.counter != nullptr
                              ? parts.counter->time_integration().deformation()
                              : Deformation(),
                    found = mpi::broadcast(own, 0, parts.context.communicator());
  of_counter.add(found);
  judge(
    found, [](const CellExtreme &) { return "a cell of the counter body"; }, n);
  require_precision(of_counter, n, parts.time);
}

template <int dim>
void TransientRun<dim>::judge(const Deformation &found,
                              const PlaceText &place,
                              const std::uint64_t n)
{
  require_upright_cells(found, n, parts.time, parts.parameters, parts.scales, place);
  const std::string warning =
    large_strain_warning(found, parts.parameters, parts.scales, place,
                         " in step " + std::to_string(n) +
                           " at t = " + quantity_text(n * parts.time.step.dt, "s"));
  if (!warning.empty() && !warned)
    parts.context.warn(warning);
  warned = warned || !warning.empty();
}

template <int dim>
bool TransientRun<dim>::control(const std::uint64_t n)
{
  const RunRequest wanted = statistics.request(n, parts.body.energy.get());
  if (wanted == RunRequest::look)
    monitor.check(n);
  parts.context.progress().update(n, n * parts.time.step.dt);
  interrupted    = wanted == RunRequest::stop;
  at_limit_cycle = wanted == RunRequest::end && n < parts.time.n_steps;
  if (wanted == RunRequest::save || wanted == RunRequest::stop)
    save();
  return wanted < RunRequest::stop;
}

template <int dim>
CheckpointPosition TransientRun<dim>::position() const
{
  CheckpointPosition p;
  p.step           = stepper.step_number();
  p.time           = p.step * parts.time.step.dt;
  p.by_limit_cycle = at_limit_cycle;
  p.at_end         = at_limit_cycle || p.step == parts.time.n_steps;
  p.snapshots      = parts.output.snapshots.n_written();
  return p;
}

template <int dim>
void TransientRun<dim>::count_time()
{
  const auto now = std::chrono::steady_clock::now();
  loop_seconds += std::chrono::duration<double>(now - counted).count();
  counted = now;
}

template <int dim>
void TransientRun<dim>::save()
{
  count_time();
  if (map)
    map->drain(stepper.step_number());
  parts.output.sync();
  if (parts.counter_output != nullptr)
    parts.counter_output->snapshots.sync();
  parts.checkpoint.write(position(), save_state(*this));
}

template <int dim>
void TransientRun<dim>::restore()
{
  parts.checkpoint.restore(*this);
  at_limit_cycle = parts.checkpoint.position().by_limit_cycle;
  parts.context.log("Resumed at step " + std::to_string(stepper.step_number()) +
                    ", t = " + to_text(stepper.step_number() * parts.time.step.dt) +
                    " s");
}

template <int dim>
std::vector<StepObserver *> TransientRun<dim>::observers()
{
  std::vector<StepObserver *> all;
  const auto add = [&](StepObserver &observer, const char *name) {
    all.push_back(parts.body.profile.template timed<TimedObserver>(observer, name));
  };
  add(monitor, "Stability monitor");
  add(strains, "Strains");
  if (parts.body.energy)
    add(*parts.body.energy, "Energies");
  if (parts.counter != nullptr && parts.counter->energy)
    add(*parts.counter->energy, "Energies");
  if (parts.counter_output != nullptr)
    add(parts.counter_output->snapshots, "Snapshots");
  for (ProbeRecorder *probes : {parts.probes, parts.probes_below})
    if (probes != nullptr)
      add(*probes, "Probes");
  if (Snapshots<dim> &snapshots = parts.output.snapshots; snapshots.are_wanted())
    {
      add(snapshots, "Snapshots");
      monitor.guard(snapshots);
    }
  if (map)
    {
      add(*map, "Map of the contact");
      monitor.guard(*map);
    }
  return all;
}

template <int dim>
TransientResult TransientRun<dim>::advance()
{
  RunContext &context       = parts.context;
  const std::uint64_t n_end = parts.time.n_steps;
  Timer *const timer        = parts.body.profile.timer;
  parts.output.begin(stepper.step_number(), parts.checkpoint.position().snapshots,
                     map.get());
  if (parts.counter_output != nullptr)
    parts.counter_output->begin(parts.checkpoint.position().snapshots);
  const auto watching = observers();
  context.progress().start("Sliding", n_end, parts.n_cells, stepper.step_number());
  counted = std::chrono::steady_clock::now();
  if (!at_limit_cycle)
    {
      const auto scope = context.timer().scope("Time loop");
      run_time_loop(
        stepper, watching, n_end, control_interval(parts.n_cells),
        [this](const std::uint64_t n) { return control(n); }, timer);
      monitor.check(stepper.step_number());
    }
  context.progress().finish();
  count_time();
  if (!interrupted && parts.parameters.checkpoints.keep)
    save();
  return collect();
}

template <int dim>
TransientResult TransientRun<dim>::collect()
{
  TransientResult all{parts.parameters, parts.size, parts.time};
  statistics.collect(all);
  if (map)
    map->drain(stepper.step_number());
  strains.look(stepper.step_number());
  all.strains    = strains.so_far();
  all.of_counter = of_counter;
  // Strains before the run was resumed: each run has warnings of its own.
  if (!warned && !(all.largest_strain() <= largest_small_strain))
    parts.context.warn("the strain was " +
                       quantity_text(100. * all.largest_strain(), "%") +
                       " earlier in the run, beyond small strains: its results cannot be "
                       "trusted");
  if (parts.body.energy)
    all.energy = parts.body.energy->reduce();
  if (parts.counter != nullptr && parts.counter->energy)
    all.energy += parts.counter->energy->reduce();
  if (parts.probes != nullptr)
    all.probes = parts.probes->gather();
  if (parts.probes_below != nullptr)
    all.probes_below = parts.probes_below->gather();
  all.steps_done = stepper.step_number();
  all.friction_energy =
    mpi::sum(parts.body.boundary_work().friction, parts.context.communicator());
  all.loop_seconds = loop_seconds;
  all.interrupted  = interrupted;
  all.kernel       = stepper.kernel_name();
  return all;
}

template <int dim>
void TransientRun<dim>::keep_state()
{
  RunContext &context = parts.context;
  try
    {
      save();
      context.log(
        "The state is in the checkpoint: once the reason is mended, the same "
        "command with --resume writes the results without computing them again");
    }
  catch (const std::exception &)
    {
      context.log("The state could not be kept, either");
    }
}

template <int dim>
void TransientRun<dim>::carry_out(const bool continued,
                                  const std::function<void()> &summarize_body)
{
  RunContext &context = parts.context;
  if (continued)
    restore();
  else if (const std::string &other = parts.parameters.time.continue_from; !other.empty())
    {
      start_from_end(parts.body, other, context.communicator());
      context.log("Starts from the end of " + other);
    }
  TransientResult result = advance();
  try
    {
      const auto scope = context.timer().scope("Evaluation and output");
      parts.output.end();
      if (parts.counter_output != nullptr)
        parts.counter_output->end();
      on_root(context.communicator(), [&]() {
        result.evaluate();
        parts.output.write(result, map.get());
        if (parts.counter_output != nullptr)
          parts.counter_output->write(conditions_of_result(result), result.probes_below);
        summarize_body();
        result.write_summary(context);
      });
    }
  catch (...)
    {
      keep_state();
      throw;
    }
  if (result.interrupted)
    throw Interrupted("stopped on request after step " +
                      std::to_string(result.steps_done) +
                      "; what was observed so far is in " + context.output_folder() +
                      ", and the same command with --resume goes on from there");
  if (parts.parameters.checkpoints.end)
    write_run_end(parts.body, result.steps_done * parts.time.step.dt,
                  context.output_folder(), context.communicator());
  // The state is dropped only after all results are written.
  context.write_summary();
  parts.checkpoint.complete(position());
}

template class TransientRun<2>;
template class TransientRun<3>;
} // namespace mesoslip
