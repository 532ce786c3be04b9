#include "sliding/transient/run_plan.h"

#include "base/errors.h"
#include "dynamics/critical_time_step.h"
#include "material/plausibility.h"
#include "observation/steady_record.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
/** Critical time step by the frequency of a single cell, which is free to compute: below
 * the true one. */
double lower_bound(const UniformMaterial &material, const StepParameters &step)
{
  return critical_time_step(element_frequency_bound(material), step.beta2, step.beta);
}

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
  const double n_probes          = static_cast<double>(o.probes.size());
  double numbers = history_numbers * n_steps / parameters.history_interval +
                   probe_numbers * n_probes * n_steps / o.probe_interval;
  if (parameters.energy_interval > 0)
    numbers += energy_numbers * n_steps / parameters.energy_interval;
  return sizeof(double) * numbers;
}

/** "1e+06 steps of 5e-09 s, 95 % of the critical time step, which ...". */
std::string steps_text(const ContactParameters &parameters,
                       const UniformMaterial &material,
                       const double n_steps)
{
  std::ostringstream text;
  text.precision(3);
  text << n_steps << " steps of " << parameters.time.end_time / n_steps << " s";
  if (!std::isnan(parameters.step.dt))
    text << " (Time/Time step)";
  else if (const std::string warning = damping_warning(parameters, material, "them");
           !warning.empty())
    text << ": " << warning;
  else
    text << " (" << 100. * parameters.time.safety << " % of the critical time step)";
  return text.str();
}
} // namespace

std::string TimeStepChoice::text() const
{
  const auto nanoseconds = [](const double t) { return quantity_text(1e9 * t, "ns"); };
  return "Time step " + nanoseconds(step.dt) + ", " +
         quantity_text(100. * step.dt / critical, "%") + " of the critical " +
         nanoseconds(critical) + "; beta2 = " + quantity_text(step.beta2, "") +
         ", beta = " + nanoseconds(step.beta) + "; " + std::to_string(n_steps) + " steps";
}

void require_frequency(const UniformMaterial &material)
{
  const double omega = element_frequency_bound(material);
  // Its square is multiplied and divided by lengths and times.
  if (!(omega > 1e-100 && omega < 1e100))
    throw UserError("Body: stiffness, density and cells of " +
                    to_text(material.grid().spacing[0]) + " x " +
                    to_text(material.grid().spacing[1]) +
                    " m give a cell no frequency of vibration that can be computed with; "
                    "are Size in m, "
                    "Stiffness in Pa and Density in kg/m^3?");
}

unsigned int statistics_interval(const UniformMaterial &material, const double dt)
{
  const UniformGrid<2> &grid = material.grid();
  const double crossing =
    crossing_time(material) * std::min(1., grid.extent(0) / grid.extent(1));
  return static_cast<unsigned int>(std::clamp(crossing / (6. * dt), 1., 10.));
}

TimeStepChoice choose_time_step(const ContactParameters &parameters,
                                const UniformMaterial &material)
{
  TimeStepChoice choice;
  StepParameters &step = choice.step = parameters.step;
  choice.critical = critical_time_step(material, step.beta2, step.beta);
  if (std::isnan(step.dt))
    step.dt = parameters.time.safety * choice.critical;
  if (parameters.time.check_time_step && step.dt > choice.critical)
    throw UserError("Time/Time step: " + to_text(step.dt) + " s is above the critical " +
                    to_text(choice.critical) +
                    " s, the run would be unstable; use auto or a smaller one");
  choice.n_steps =
    static_cast<std::uint64_t>(std::ceil(parameters.time.end_time / step.dt - 1e-9));
  choice.statistics_interval = statistics_interval(material, step.dt);
  return choice;
}

LoadRange load_range(const LoadHistory &load, const double end)
{
  constexpr unsigned int n = 1000;
  LoadRange range;
  range.smallest = range.largest = load(0.);
  for (unsigned int k = 0; k <= n; ++k)
    {
      const double value = load(end * k / n);
      range.finite       = range.finite && std::isfinite(value);
      range.smallest     = std::min(range.smallest, value);
      range.largest      = std::max(range.largest, value);
    }
  return range;
}

BodyScales::BodyScales(const UniformMaterial &material)
{
  for (const ElasticPhase<2> &c : material.phases())
    {
      stiffness  = std::max(stiffness, c.stiffness(1, 1));
      wave_speed = std::max(wave_speed, std::sqrt(c.stiffness(1, 1) / c.density));
    }
  density =
    material.total_mass() / (material.grid().extent(0) * material.grid().extent(1));
}

double crossing_time(const UniformMaterial &material)
{
  return material.grid().extent(1) / BodyScales(material).wave_speed;
}

double largest_number_of_steps(const ContactParameters &parameters,
                               const UniformMaterial &material)
{
  const double dt = parameters.step.dt, bound = lower_bound(material, parameters.step);
  if (dt > bound && parameters.time.check_time_step)
    choose_time_step(parameters, material); // above the true one as well?
  return std::ceil(parameters.time.end_time /
                   (std::isnan(dt) ? parameters.time.safety * bound : dt));
}

std::string damping_warning(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const std::string &shortened)
{
  StepParameters undamped = parameters.step;
  undamped.beta           = 0.;
  const double shortening =
    lower_bound(material, undamped) / lower_bound(material, parameters.step);
  if (shortening <= 10.)
    return "";
  std::ostringstream text;
  text.precision(3);
  text << "Time/Rayleigh beta = " << parameters.step.beta << " s makes " << shortened
       << " " << shortening << " times shorter than without damping; is it in s?";
  return text.str();
}

double n_snapshots(const ContactParameters &parameters, const double n_steps)
{
  const ObservationParameters &o = parameters.observation;
  if (!(o.snapshots_interval > 0.))
    return 0.;
  const double end  = parameters.time.end_time,
               to   = std::isnan(o.snapshots_to) ? end : o.snapshots_to,
               last = std::min(to, end);
  if (!(o.snapshots_from <= last))
    throw UserError("Snapshots/From: " + to_text(o.snapshots_from) +
                    " s is after the last one, at " + to_text(last) +
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
  // With the samples for the statistics, which are not written.
  const double dt = parameters.time.end_time / n_steps;
  const double samples =
    SteadyRecord::numbers(n_steps / statistics_interval(material, dt));
  return {history_bytes(parameters, n_steps) + sizeof(double) * samples,
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
