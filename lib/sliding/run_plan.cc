#include "sliding/run_plan.h"

#include "base/errors.h"
#include "dynamics/critical_time_step.h"
#include "material/plausibility.h"

#include <algorithm>
#include <cmath>

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
    BodyScales(material).crossing * std::min(1., grid.extent(0) / grid.extent(1));
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
  const UniformGrid<2> &grid = material.grid();
  density                    = material.total_mass() / (grid.extent(0) * grid.extent(1));
  crossing                   = grid.extent(1) / wave_speed;
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
  return brief_text(3, "Time/Rayleigh beta = ", parameters.step.beta, " s makes ",
                    shortened, " ", shortening,
                    " times shorter than without damping; is it in s?");
}

ResourceNeed field_memory(const ContactAnalysis analysis, const UniformGrid<2> &grid)
{
  // In floating point, as too many nodes for a machine are a number, too.
  // Displacement and increment; the static solvers as measured with the multigrid.
  const bool stepping = analysis == ContactAnalysis::transient;
  return {(stepping ? 33. : 330.) * (grid.cells[0] + 1.) * (grid.cells[1] + 1.),
          "reduce Body/Cells"};
}
} // namespace mesoslip
