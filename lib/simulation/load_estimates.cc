#include "simulation/load_estimates.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
double size_of(const std::array<double, 2> &v)
{
  return std::hypot(v[0], v[1]);
}
} // namespace

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
  for (const ElasticClass &c : material.classes())
    {
      stiffness  = std::max(stiffness, c.stiffness(1, 1));
      wave_speed = std::max(wave_speed, std::sqrt(c.stiffness(1, 1) / c.density));
    }
  density =
    material.total_mass() / (material.grid().extent(0) * material.grid().extent(1));
}

std::vector<LoadEstimate> load_estimates(const ContactParameters &parameters,
                                         const UniformMaterial &material)
{
  const BodyScales body(material);
  const bool pressed = parameters.top.kind != TopSetup::Kind::held;
  const double pressure =
    load_range(parameters.top.pressure, parameters.time.end_time).largest_size();
  const double velocity     = size_of(parameters.body.initial_velocity);
  const double acceleration = size_of(parameters.body.acceleration);
  return {{"Top/Pressure", pressure, "Pa", pressed ? pressure / body.stiffness : 0.},
          {"Body/Initial velocity", velocity, "m/s", velocity / body.wave_speed},
          {"Body/Acceleration", acceleration, "m/s^2",
           body.density * acceleration * material.grid().extent(1) / body.stiffness}};
}
} // namespace mesoslip
