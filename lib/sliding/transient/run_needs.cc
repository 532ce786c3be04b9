#include "sliding/transient/run_needs.h"

#include "base/errors.h"
#include "observation/steady_record.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
double number_of_snapshots(const ContactParameters &parameters, const double n_steps)
{
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return 0.;
  const double end  = parameters.time.end_time,
               to   = std::isnan(o.snapshots_to) ? end : o.snapshots_to,
               last = std::min(to, end);
  if (!(o.snapshots_from <= last))
    throw UserError("Snapshots/From: " + to_text(o.snapshots_from) + " s is after " +
                    (last == end ? "the end of the run (Time/End time = "
                                 : "the last one (Snapshots/To = ") +
                    to_text(last) +
                    " s), so there would be none; set it earlier, or Interval = 0");
  return std::min(std::floor((to - o.snapshots_from) / o.snapshots_interval) + 1.,
                  n_steps);
}

double number_of_map_samples(const ContactParameters &parameters, const double n_steps)
{
  const ContactMapParameters &map = parameters.map;
  if (!(map.interval > 0.))
    return 0.;
  const double end  = parameters.time.end_time,
               last = std::isnan(map.to) ? end : std::min(map.to, end);
  if (!(map.from <= last && std::round(map.from / end * n_steps) < n_steps))
    throw UserError("Contact map/From: " + to_text(map.from) +
                    " s is after the last sample, at " + to_text(last) +
                    " s, so there would be none; set it earlier, or Interval = 0");
  return std::min(std::floor((last - map.from) / map.interval) + 1., n_steps);
}

/** Bytes of the loads of the contact nodes at the ends of blocks. */
double node_load_bytes(const ContactParameters &parameters, const double n_contact)
{
  return parameters.wants_node_loads()
           ? 2. * sizeof(double) * n_contact * (parameters.observation.blocks + 2.)
           : 0.;
}

/** Bytes of all records taken every few steps. */
double history_bytes(const ContactParameters &parameters, const TimeStepChoice &time)
{
  // Numbers per sample: histories with the reference node, a probe, the energies.
  constexpr double history_numbers = 18., probe_numbers = 11., energy_numbers = 10.;
  const ObservationParameters &o = parameters.observation;
  const std::size_t below =
    parameters.counter ? parameters.counter->observation.probes.size() : 0;
  const double n_probes = static_cast<double>(o.probes.size() + below);
  const double n_steps  = static_cast<double>(time.n_steps);
  double numbers =
    history_numbers * n_steps / time.interval(parameters.history_interval) +
    probe_numbers * n_probes * n_steps / time.interval(parameters.probe_interval);
  if (parameters.energy_interval > 0)
    numbers += energy_numbers * n_steps / parameters.energy_interval;
  return sizeof(double) * numbers;
}

/** Advice against too many samples. */
std::string fewer_samples(const ContactParameters &parameters,
                          const BodyScales &scales,
                          const double n_steps)
{
  const std::string damping = damping_warning(parameters, scales, "them");
  return brief_text(3,
                    "increase Observation/History interval (and Probe interval, Energy "
                    "interval), or reduce Time/End time (in s), now ",
                    n_steps, " steps of ", parameters.time.end_time / n_steps, " s",
                    !std::isnan(parameters.step.dt) ? " (Time/Time step)"
                    : !damping.empty()
                      ? ": " + damping
                      : brief_text(3, " (", 100. * parameters.time.safety,
                                   " % of the critical time step)"));
}
} // namespace

std::string RunNeeds::text() const
{
  return to_text(n_snapshots) + " snapshots, " +
         (n_map_samples > 0. ? "a map of the contact with " + to_text(n_map_samples) +
                                 " samples (" + bytes_text(map_bytes) + "), "
                             : "");
}

std::vector<std::uint64_t> snapshot_steps(const ContactParameters &parameters,
                                          const TimeStepChoice &time)
{
  std::vector<std::uint64_t> steps;
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return steps;
  // There are no snapshots after the last step or between steps.
  const double dt = time.step.dt, from = o.snapshots_from,
               spacing = std::max(o.snapshots_interval, dt),
               to =
                 std::isnan(o.snapshots_to)
                   ? parameters.time.end_time
                   : std::min(o.snapshots_to, static_cast<double>(time.n_steps + 1) * dt);
  if (!(to >= from))
    return steps;
  const auto n = static_cast<std::uint64_t>(std::floor((to - from) / spacing + 1e-6));
  for (std::uint64_t k = 0; k <= n; ++k)
    {
      const auto step = static_cast<std::uint64_t>(
        std::llround((from + static_cast<double>(k) * spacing) / dt));
      if (step < time.n_steps && (steps.empty() || step > steps.back()))
        steps.push_back(step);
    }
  return steps;
}

RunNeeds run_needs(const ContactParameters &parameters,
                   const BodyScales &scales,
                   const TimeStepChoice &time,
                   const double n_dofs,
                   const double n_contact)
{
  const double n_steps = static_cast<double>(time.n_steps);
  RunNeeds needs;
  needs.n_snapshots = number_of_snapshots(parameters, n_steps);
  // Includes the samples for statistics, which are not written.
  const double histories = history_bytes(parameters, time);
  needs.n_map_samples    = number_of_map_samples(parameters, n_steps);
  needs.map_bytes        = needs.n_map_samples * n_contact *
                    contact_map_setup(parameters, parameters.time.end_time / n_steps)
                      .bytes_per_node(parameters.mesh.mesh.dim);
  const double sums = node_load_bytes(parameters, n_contact);
  needs.memory      = {histories + sums +
                         sizeof(double) *
                           SteadyRecord::numbers(n_steps / time.statistics_interval),
                       fewer_samples(parameters, scales, n_steps)};

  // Displacement, increment and histories, in the old and in the new checkpoint.
  const double field = sizeof(double) * n_dofs, fields = needs.n_snapshots * field;
  needs.disk = {fields + needs.map_bytes + histories + sums +
                  2. * (2. * field + needs.memory.bytes),
                needs.memory.remedy};
  if (needs.map_bytes > std::max(fields, histories))
    needs.disk.remedy =
      to_text(needs.n_map_samples) +
      " samples of the map of the contact take most of it: increase Contact "
      "map/Interval, now " +
      to_text(parameters.map.interval) + " s, set From and To, or name fewer Fields";
  else if (fields > histories)
    needs.disk.remedy = to_text(needs.n_snapshots) +
                        " snapshots take most of it: increase Snapshots/Interval, now " +
                        to_text(parameters.observation.snapshots_interval) +
                        " s, set From and To, or reduce Time/End time (in s), now " +
                        to_text(parameters.time.end_time) + " s";
  return needs;
}
} // namespace mesoslip
