#include "base/errors.h"
#include "dynamics/critical_time_step.h"
#include "parameters/parameters.h"
#include "sliding/transient/run_plan.h"

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

double LoadRange::largest_size() const
{
  return std::max(std::fabs(smallest), std::fabs(largest));
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
  const TimeParameters &t = parameters.time;
  const double dt =
    std::isnan(t.time_step)
      ? t.safety * critical_time_step(element_frequency_bound(material), t.beta2, t.beta)
      : t.time_step;
  return std::ceil(t.end_time / dt);
}

std::string damping_warning(const ContactParameters &parameters,
                            const UniformMaterial &material,
                            const std::string &shortened)
{
  const TimeParameters &t = parameters.time;
  const double omega      = element_frequency_bound(material);
  const double shortening =
    critical_time_step(omega, t.beta2, 0.) / critical_time_step(omega, t.beta2, t.beta);
  if (shortening <= 10.)
    return "";
  std::ostringstream text;
  text.precision(3);
  text << "Time/Rayleigh beta = " << t.beta << " s makes " << shortened << " "
       << shortening << " times shorter than without damping; is it in s?";
  return text.str();
}
} // namespace mesoslip
