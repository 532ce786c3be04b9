#include "sliding/transient/transient.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/exchange.h"
#include "base/timer.h"
#include "exchange/grid_file.h"
#include "io/drafts.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "program/run_context.h"
#include "sliding/counter/counter_text.h"
#include "sliding/counter/partners.h"
#include "sliding/sweep/run_end.h"
#include "sliding/transient/run_draft.h"
#include "sliding/transient/transient_run.h"

#include <cmath>
#include <optional>
#include <ostream>
#include <utility>

namespace mesoslip
{
namespace
{
/** The counter body of a body, or null. Collective. @throws UserError */
template <int dim>
std::unique_ptr<GivenBody<dim>> counter_of(const GivenBody<dim> &body)
{
  return body.parameters.counter ? make_given_body<dim>(*body.parameters.counter)
                                 : nullptr;
}

/** Digest of the end of the run in @p folder; empty without a folder. Collective.
 * @throws UserError */
std::string start_text(const std::string &folder)
{
  std::string digest;
  if (folder.empty())
    return digest;
  on_root(MPI_COMM_WORLD, [&]() {
    const std::string file = run_end_file(folder);
    require_readable_file("Time/Continue from: ", file,
                          "run it with Checkpoints/Write end = true");
    digest = Digest().add_file(file).hex();
  });
  broadcast(MPI_COMM_WORLD, digest);
  return "Start = " + digest + "\n";
}
} // namespace

template <int dim>
TransientAnalysis<dim>::TransientAnalysis(std::unique_ptr<GivenBody<dim>> given,
                                          const Keys &keys)
  : BodyAnalysis<dim>(std::move(given))
  , counter(counter_of(*body))
  , meeting(counter ? meeting_of(*body, *counter) : SurfaceMeeting())
  , identity(run_identity(keys,
                          parameters,
                          facts.contents + (counter ? counter->facts().contents : "") +
                            start_text(parameters.time.continue_from)))
  , time(time_step())
  , needs(run_needs(parameters,
                    facts.scales,
                    time,
                    static_cast<double>(
                      dim * (facts.n_points + (counter ? counter->facts().n_points : 0))),
                    static_cast<double>(facts.size.friction.size())))
{
  require_memory(needs.memory);
}

template <int dim>
TimeStepChoice TransientAnalysis<dim>::time_step() const
{
  constexpr double most_steps = 1e15; // a thousand years of computing
  TimeStepChoice choice = choose_time_step(parameters, facts.scales.highest_frequency);
  if (counter)
    choice.shorten(
      choose_time_step(*parameters.counter, counter->facts().scales.highest_frequency),
      parameters.time.end_time);
  const double end_time = parameters.time.end_time, n = end_time / choice.step.dt;
  if (!(n < most_steps))
    throw UserError("Time/End time: " + to_text(end_time) + " s are " +
                    quantity_text(n, "") + " steps, more than any run can do; are " +
                    parameters.mesh.size_key() +
                    " in m, stiffness in Pa, density in kg/m^3 and times in s?");
  choice.statistics_interval =
    statistics_interval(facts.shortest_side / facts.scales.wave_speed, choice.step.dt);
  check_steady_from(parameters, n, choice.statistics_interval);
  return choice;
}

template <int dim>
std::vector<std::string> TransientAnalysis<dim>::warnings() const
{
  return implausible_run(parameters, facts.scales, static_cast<double>(time.n_steps));
}

template <int dim>
void TransientAnalysis<dim>::describe(std::ostream &out) const
{
  body->describe(out, needs.memory.bytes);
  if (counter)
    {
      for (const std::string &line : counter->told())
        out << text_of_counter(line) << '\n';
      out << text_of(meeting) << '\n';
      for (const std::string &warning : counter->facts().warnings)
        out << "warning: " << text_of_counter(warning) << '\n';
    }
  out << time.text() << "\nTimes: " << crossing_text(parameters, facts.scales) << '\n'
      << needs.text() << bytes_text(needs.disk.bytes) << " on the disk\n";
  for (const std::string &warning : warnings())
    out << "warning: " << warning << '\n';
}

template <int dim>
std::size_t TransientAnalysis<dim>::n_cells() const
{
  return facts.size.n_cells + (counter ? counter->facts().size.n_cells : 0);
}

template <int dim>
unsigned int TransientAnalysis<dim>::useful_ranks() const
{
  const double updates =
    static_cast<double>(n_cells()) * static_cast<double>(time.n_steps);
  return updates < facts.long_run ? 1 : facts.most_ranks;
}

/** Whether there are snapshots or probes of a counter body. */
template <int dim>
bool TransientAnalysis<dim>::has_counter_file() const
{
  return !counter->facts().probes.empty() || !snapshot_steps(parameters, time).empty();
}

template <int dim>
void TransientAnalysis<dim>::write_draft(const std::string &folder) const
{
  on_root(MPI_COMM_WORLD, [&]() {
    const DraftMark mark(false);
    Hdf5File file =
      body->create_file(path_of_draft(folder, "dynamics.h5"), dynamics_format);
    write_transient_draft(file, parameters, time, body->vectors_shape());
    const auto add_probes = [&](Hdf5File &to, const std::vector<ProbePoint> &probes) {
      for (const ProbePoint &probe : probes)
        add_draft_probe(to, probe.name,
                        {probe.position.begin(), probe.position.begin() + dim},
                        time.interval(parameters.probe_interval), time);
    };
    add_probes(file, facts.probes);
    file.close();
    if (counter && has_counter_file())
      {
        Hdf5File below =
          counter->create_file(path_of_draft(folder, "counter_body.h5"), dynamics_format);
        write_transient_draft(below, parameters, time, counter->vectors_shape(), true);
        add_probes(below, counter->facts().probes);
        below.close();
      }
  });
}

template <int dim>
void TransientAnalysis<dim>::run(RunContext &context)
{
  if (context.options().summary_only &&
      (parameters.map.interval > 0. || !snapshot_steps(parameters, time).empty()))
    throw UserError(
      "--summary-only: there would be no file for the snapshots or the map of "
      "the contact; set Snapshots/Interval and Contact map/Interval to 0");
  std::optional<Timer::Scope> starting = context.timer().scope("Start of the run");
  body->log(context);
  if (counter)
    {
      for (const std::string &line : counter->told())
        context.log(text_of_counter(line));
      context.log(text_of(meeting));
      for (const std::string &warning : counter->facts().warnings)
        context.warn(text_of_counter(warning));
    }
  TransientCheckpoint checkpoint(context, parameters.checkpoints,
                                 identity + "Time step in s = " + to_text(time.step.dt) +
                                   "\n");
  const auto found = checkpoint.begin(time.n_steps);
  if (found == TransientCheckpoint::Found::complete)
    return;
  context.log(time.text());
  for (const std::string &warning : warnings())
    context.warn(warning);

  CounterMotion<dim> below;
  if (counter)
    below = counter->start_below(setup_below(*parameters.counter, counter->facts().size,
                                             time.step,
                                             time.interval(parameters.probe_interval)),
                                 context);
  below.meeting            = meeting;
  SlidingSetup setup       = run_setup(parameters, facts.size, time);
  setup.contact.is_coupled = meeting.couples();
  if (const std::string &other = parameters.time.continue_from; !other.empty())
    {
      const LoadsAtEnd loads      = loads_at_end(other, context.communicator());
      setup.contact.flat_velocity = setup.contact.flat_velocity.from(loads.flat_velocity);
      setup.top.pressure          = setup.top.pressure.from(loads.pressure);
    }
  const BodyInMotion<dim> motion = body->start(setup, context, &below);
  RunOutput<dim> output(context, *body, time, motion.displacement);
  const auto of_counter_output = counter_output(context, below);
  TransientRun<dim> run({parameters, time, facts.scales, facts.size, n_cells(),
                         facts.place, *motion.body, motion.probes.get(), below.body.get(),
                         below.probes.get(), of_counter_output.get(), output, checkpoint,
                         context});
  starting.reset();
  run.carry_out(found == TransientCheckpoint::Found::state,
                [&]() { body->summarize("transient", context); });
}

template <int dim>
std::unique_ptr<CounterOutput<dim>>
TransientAnalysis<dim>::counter_output(RunContext &context,
                                       const CounterMotion<dim> &below) const
{
  if (!below.body || !has_counter_file())
    return nullptr;
  return std::make_unique<CounterOutput<dim>>(context.file("counter_body.h5"), *counter,
                                              below, snapshot_steps(parameters, time),
                                              time.step.dt, context.timer());
}

template class TransientAnalysis<2>;
template class TransientAnalysis<3>;
} // namespace mesoslip
