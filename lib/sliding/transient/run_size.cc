#include "base/errors.h"
#include "observation/steady_record.h"
#include "parameters/parameters.h"
#include "sliding/transient/run_plan.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Numbers of a sample of the histories with the reference node; of a probe; of the
 * energies. */
constexpr double history_numbers = 18., probe_numbers = 11., energy_numbers = 10.;

/** In floating point: too many nodes for a machine are a number, too. */
double n_nodes(const UniformGrid<2> &grid)
{
  return (grid.cells[0] + 1.) * (grid.cells[1] + 1.);
}

/** Bytes of all that is recorded every few steps. */
double history_bytes(const ContactParameters &parameters, const double n_steps)
{
  const ObservationParameters &o = parameters.observation;
  double numbers                 = history_numbers * n_steps / o.history_interval;
  numbers +=
    probe_numbers * static_cast<double>(o.probes.size()) * n_steps / o.probe_interval;
  if (o.energy_interval > 0)
    numbers += energy_numbers * n_steps / o.energy_interval;
  return sizeof(double) * numbers;
}

/** Bytes of the samples for the statistics, which are not written. */
double series_bytes(const ContactParameters &parameters,
                    const UniformMaterial &material,
                    const double n_steps)
{
  const double dt = parameters.time.end_time / n_steps;
  return sizeof(double) *
         SteadyRecord::numbers(n_steps / statistics_interval(material, dt));
}

/** "1e+06 steps of 5e-09 s, 95 % of the critical time step, which ...". */
std::string steps_text(const ContactParameters &parameters,
                       const UniformMaterial &material,
                       const double n_steps)
{
  const TimeParameters &t = parameters.time;
  std::ostringstream text;
  text.precision(3);
  text << n_steps << " steps of " << t.end_time / n_steps << " s";
  if (!std::isnan(t.time_step))
    text << " (Time/Time step)";
  else if (const std::string warning = damping_warning(parameters, material, "them");
           !warning.empty())
    text << ": " << warning;
  else
    text << " (" << 100. * t.safety << " % of the critical time step)";
  return text.str();
}
} // namespace

double n_snapshots(const ContactParameters &parameters, const double n_steps)
{
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return 0.;
  const double to =
    std::isnan(o.snapshots_to) ? parameters.time.end_time : o.snapshots_to;
  if (!(o.snapshots_from <= std::min(to, parameters.time.end_time)))
    throw UserError("Snapshots/From: " + to_text(o.snapshots_from) +
                    " s is after the last one, at " +
                    to_text(std::min(to, parameters.time.end_time)) +
                    " s, so there would be none; set it earlier, or Interval = 0");
  return std::min(std::floor((to - o.snapshots_from) / o.snapshots_interval) + 1.,
                  n_steps);
}

ResourceNeed field_memory(const ContactAnalysis analysis, const UniformGrid<2> &grid)
{
  // Displacement and increment; the static solvers as measured with the multigrid.
  const bool stepping = analysis == ContactAnalysis::transient;
  return {(stepping ? 33. : 330.) * n_nodes(grid), "reduce Body/Cells"};
}

ResourceNeed history_memory(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const double n_steps)
{
  return {history_bytes(parameters, n_steps) +
            series_bytes(parameters, material, n_steps),
          "increase Observation/History interval (and Probe interval, Energy interval), "
          "or reduce Time/End time, now " +
            steps_text(parameters, material, n_steps)};
}

ResourceNeed dynamics_file_size(const ContactParameters &parameters,
                                const UniformMaterial &material,
                                const double n_steps)
{
  const double snapshots = n_snapshots(parameters, n_steps);
  const double field     = 2. * sizeof(double) * n_nodes(material.grid());
  const double fields    = snapshots * field;
  const double histories = history_bytes(parameters, n_steps);
  // Displacement, increment and histories, in the old one and in the new.
  ResourceNeed need        = history_memory(parameters, material, n_steps);
  const double checkpoints = 2. * (2. * field + need.bytes);
  if (fields > histories)
    need.remedy = to_text(snapshots) +
                  " snapshots take most of it: increase Snapshots/Interval, now " +
                  to_text(parameters.observation.snapshots_interval) +
                  " s, or set From and To";
  need.bytes = fields + histories + checkpoints;
  return need;
}
} // namespace mesoslip
