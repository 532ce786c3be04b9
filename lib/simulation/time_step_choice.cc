#include "simulation/time_step_choice.h"

#include "elasticity/critical_time_step.h"
#include "io/errors.h"
#include "io/parameters.h"
#include "simulation/run_size.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
std::string nanoseconds(const double t)
{
  std::ostringstream text;
  text.precision(4);
  text << t * 1e9 << " ns";
  return text.str();
}
} // namespace

std::string TimeStepChoice::text() const
{
  std::ostringstream out;
  out.precision(4);
  out << "Time step " << nanoseconds(step.dt) << ", " << 100. * step.dt / critical
      << " % of the critical " << nanoseconds(critical) << "; beta2 = " << step.beta2
      << ", beta = " << nanoseconds(step.beta) << "; " << n_steps << " steps";
  return out.str();
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
  const TimeParameters &t = parameters.time;
  TimeStepChoice choice;
  choice.critical          = critical_time_step(material, t.beta2, t.beta);
  choice.step.beta2        = t.beta2;
  choice.step.beta         = t.beta;
  choice.step.acceleration = parameters.body.acceleration;
  choice.step.dt = std::isnan(t.time_step) ? t.safety * choice.critical : t.time_step;
  if (t.check_time_step && choice.step.dt > choice.critical)
    throw UserError("Time/Time step: " + to_text(choice.step.dt) +
                    " s is above the critical " + to_text(choice.critical) +
                    " s, the run would be unstable; use auto or a smaller one");
  choice.n_steps = static_cast<std::uint64_t>(
    std::ceil(parameters.time.end_time / choice.step.dt - 1e-9));
  choice.statistics_interval = statistics_interval(material, choice.step.dt);
  return choice;
}

void check_time_step(const ContactParameters &parameters, const UniformMaterial &material)
{
  const TimeParameters &t = parameters.time;
  // The bound of a single cell is free; the exact limit takes some operator applications.
  if (!std::isnan(t.time_step) && t.check_time_step &&
      t.time_step >
        critical_time_step(element_frequency_bound(material), t.beta2, t.beta))
    choose_time_step(parameters, material);
}
} // namespace mesoslip
