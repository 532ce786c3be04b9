#include "material/plausibility.h"
#include "sliding/run_plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace mesoslip
{
namespace
{
/** A load, and the strain that it causes on its own in the body. */
struct LoadEstimate
{
  std::string key;  ///< key of the load
  double value;     ///< largest magnitude, in its unit
  const char *unit; ///< Pa, m/s or m/s^2
  double strain;    ///< P / D22, v / c, or rho a H / D22 [-]
};
} // namespace

std::string likely_cause(const ContactParameters &parameters, const BodyScales &body)
{
  const auto size_of = [](const auto &v) { return std::hypot(v[0], v[1], v[2]); };
  const double end   = parameters.time.end_time,
               v     = size_of(parameters.body.initial_velocity),
               g     = size_of(parameters.step.acceleration);
  std::vector<LoadEstimate> loads = {
    {"Body/Initial velocity", v, "m/s", v / body.wave_speed},
    {"Body/Acceleration", g, "m/s^2", body.density * g * body.height / body.stiffness}};
  for (const SideSupport *side : parameters.suspended())
    {
      const Suspension &on = side->suspension;
      for (unsigned int c = 0; c < 3; ++c)
        {
          const double by   = load_range(on.motion[c], end).largest_size(),
                       pull = std::fabs(on.traction(c, {}, 0.));
          loads.push_back(
            {side->key("Motion"), by, "m", on.stiffness[c] * by / body.stiffness});
          loads.push_back({side->key("Traction"), pull, "Pa", pull / body.stiffness});
        }
      if (side == &parameters.top && parameters.top.is_held())
        continue;
      const double p = load_range(side->pressure, end).largest_size();
      loads.push_back({side->key("Pressure"), p, "Pa", p / body.stiffness});
    }
  const LoadEstimate &worst = *std::max_element(
    loads.begin(), loads.end(),
    [](const LoadEstimate &a, const LoadEstimate &b) { return a.strain < b.strain; });
  if (!(worst.strain > 0.1 * largest_small_strain))
    return "the motion of the body, as its loads alone strain it little: it is thrown, "
           "turns freely, or is dragged along by the flat; hold it, lower the friction, "
           "or shorten the run";
  return worst.key + " = " + quantity_text(worst.value, worst.unit) +
         ", which alone strains the body by about " +
         quantity_text(100. * worst.strain, "%") + "; reduce it, or check its unit";
}
} // namespace mesoslip
