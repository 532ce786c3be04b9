#include "sliding/transient/run_statistics.h"

#include "base/errors.h"
#include "base/object_exchange.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
LimitCycleCriterion limit_cycle_criterion(const ContactParameters &parameters,
                                          const BodySize &size)
{
  LimitCycleCriterion criterion = parameters.observation.limit_cycle;
  criterion.reference_speed     = std::fabs(parameters.contact.flat_velocity.amplitude());
  criterion.stays_apart         = !parameters.presses_on_flat();
  const TopSetup &top           = parameters.top;
  // Expected until a vibration is detected: period of the body, or of the whole body on
  // its springs.
  criterion.expected_period =
    std::max(crossings_of_a_period * size.crossing,
             top.suspension.period((size.mass + top.platen_mass) / size.top_area));
  const std::vector<SideSupport> sides = parameters.loaded_sides();
  for (std::size_t k = 0; k < sides.size(); ++k)
    criterion.expected_period = std::max(
      criterion.expected_period,
      sides[k].suspension.period((size.mass + sides[k].platen_mass) / size.side_area[k]));
  return criterion;
}
} // namespace

std::vector<unsigned int> monitored_nodes(const unsigned int reference,
                                          const unsigned int last)
{
  std::vector<unsigned int> nodes = {reference};
  for (const unsigned int sixth : {1U, 2U, 4U, 5U})
    if (std::find(nodes.begin(), nodes.end(), sixth * last / 6) == nodes.end())
      nodes.push_back(sixth * last / 6);
  return nodes;
}

// Often enough to react to an interruption and to keep few samples waiting; seldom enough
// to cost no time, and to let the stepper combine several steps. The interval is the same
// for a resumed run, as the run may end at a limit cycle only at these steps.
std::uint64_t control_interval(const std::uint64_t n_cells)
{
  return next_multiple(std::clamp<std::uint64_t>(20000000 / n_cells, 1, 65536), 64);
}

// mu_inter uses the statistics samples from there to the end: at least three, unless the
// run is too short anyway.
void check_steady_from(const ContactParameters &parameters,
                       const double n_steps,
                       const unsigned int interval)
{
  const double from = parameters.observation.steady_from, end = parameters.time.end_time;
  const double n_samples = n_steps / interval;
  const double latest    = n_samples < static_cast<double>(TransientResult::least_samples)
                             ? end
                             : end - 2. * end / n_samples;
  if (!std::isnan(from) && !(from < end && from <= latest))
    throw UserError(
      "Observation/Steady from: " + to_text(from) +
      " s leaves fewer than three samples for statistics before Time/End time, " +
      to_text(end) + " s; set it earlier, or auto");
}

template <int dim>
RunStatistics<dim>::RunStatistics(const ContactParameters &parameters,
                                  const BodySize &size,
                                  const TimeStepChoice &time,
                                  SlidingBody<dim> &surfaces,
                                  const TransientCheckpoint &checkpoint,
                                  RunContext &context)
  : parameters(parameters)
  , time(time)
  , surfaces(surfaces)
  , checkpoint(checkpoint)
  , context(context)
  , recent_contact(time.statistics_interval, surfaces.setup.monitored_nodes, time.step)
  , recent_top(time.statistics_interval)
  , limit_cycle(limit_cycle_criterion(parameters, size),
                static_cast<unsigned int>(size.n_contact_nodes),
                parameters.energy_interval,
                context.communicator())
  , record(time.statistics_interval, time.step.dt)
{
  surfaces.contact.observe(recent_contact);
  surfaces.top.observe(recent_top);
}

template <int dim>
RunRequest RunStatistics<dim>::own_request(const std::uint64_t n,
                                           const EnergyAudit *energy)
{
  ContactHistory fresh = recent_contact.take();
  TopHistory of_top    = recent_top.take();
  sum_over_ranks(fresh, surfaces.setup.ranks);
  sum_over_ranks(of_top, surfaces.setup.ranks);
  turn_along_flat(fresh, parameters.contact.flat_direction);
  // Only rank 0 judges the contact.
  if (!context.root())
    fresh = ContactHistory();
  record.add(fresh);
  record.add(of_top);
  if (!limit_cycle.update(fresh, energy))
    return RunRequest::look;
  const bool reached =
    parameters.observation.stop_at_limit_cycle && limit_cycle.reached();
  if (reached || n >= time.n_steps)
    return RunRequest::end;
  if (context.stop_requested_here())
    return RunRequest::stop;
  return context.root() && checkpoint.due() ? RunRequest::save : RunRequest::go_on;
}

template <int dim>
RunRequest RunStatistics<dim>::request(const std::uint64_t n, const EnergyAudit *energy)
{
  const auto scope   = context.timer().scope("Limit cycle, requests");
  RunRequest largest = own_request(n, energy);
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, context.communicator());
  return largest;
}

template <int dim>
void RunStatistics<dim>::collect(TransientResult &all)
{
  // Broadcast from the last rank, the only one with the top on a grid.
  const auto of_top = [this](auto object) {
    broadcast_object(context.communicator(), object, context.n_ranks() - 1);
    return object;
  };
  all.blocks  = surfaces.contact_states(all.body.n_contact_nodes);
  all.history = surfaces.contact_recorder.history();
  all.top     = surfaces.top_recorder.history();
  sum_over_ranks(all.history, surfaces.setup.ranks);
  sum_over_ranks(all.top, surfaces.setup.ranks);
  all.top = of_top(all.top);
  if (const auto *friction = surfaces.contact.variable_friction())
    all.largest_weakening =
      mpi::max(friction->largest_weakening(), context.communicator());
  if (const auto *pair = surfaces.paired())
    all.settling = pair->settling();
  all.series = record.series();
  // If the top takes no tangential forces, contact forces are used.
  const std::vector<double> at_the_top = of_top(record.top_friction());
  if (parameters.friction_is_at_top())
    all.series.apparent_friction = at_the_top;
  const double given      = parameters.observation.steady_from;
  all.limit_cycle_reached = limit_cycle.reached();
  all.steady_from         = std::isnan(given) ? limit_cycle.steady_from() : given;
  all.limit_cycle         = limit_cycle.description();
  if (!limit_cycle.reached() || !std::isnan(given)) // it defines the steady part
    all.limit_cycle += brief_text(4, ", statistics from ", all.steady_from, " s on");
}

template class RunStatistics<2>;
template class RunStatistics<3>;
} // namespace mesoslip
