#include "sliding/complex/steady_friction.h"

#include "base/errors.h"

#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
constexpr double width = 1e-5; // relative width of finite differences

/** Time constant (s) with which a state near @p steady returns to it. */
double return_time(const CoefficientLaw &law, const double steady, const double slip_rate)
{
  SlipStep step;
  step.slip_rate  = slip_rate;
  step.touches    = true;
  const auto rest = [&](const double dt) {
    step.dt = dt;
    return (law.next_state(steady * (1. + width), step) -
            law.next_state(steady * (1. - width), step)) /
           (2. * width * steady);
  };
  double dt = 1.;
  for (unsigned int n = 0; n < 200 && rest(dt) < 0.2; ++n)
    dt *= 0.5;
  for (unsigned int n = 0; n < 200 && rest(dt) > 0.8; ++n)
    dt *= 1.5;
  return -dt / std::log(rest(dt));
}

/** Whether the state @p steady is constant during sliding. */
bool stays(const CoefficientLaw &law, const double steady, const double slip_rate)
{
  SlipStep step;
  step.dt          = 1.;
  step.slip_rate   = slip_rate;
  step.touches     = true;
  const double now = law.next_state(steady, step);
  return now == steady || std::fabs(now - steady) <= 1e-9 * std::fabs(steady);
}

void require(const bool holds, const std::string &what)
{
  if (!holds)
    throw UserError("Friction/Coefficient law: complex modes are those about steady "
                    "sliding, but the law " +
                    what);
}
} // namespace

SteadyFriction steady_friction(const CoefficientLaw &law, SlipPoint at)
{
  const auto moved = [&](double SlipPoint::*what, const double factor) {
    SlipPoint other = at;
    other.*what *= factor;
    return other;
  };
  SteadyFriction result;
  at.state           = law.steady_state(at.slip_rate);
  result.coefficient = law.coefficient(at);
  at.time            = std::numeric_limits<double>::quiet_NaN();
  require(!std::isfinite(result.coefficient) || std::isfinite(law.coefficient(at)),
          "depends on the time; leave t out of it");
  at.time = 0.;
  require(
    !law.state() || stays(law, at.state, at.slip_rate),
    "depends on a state that goes on changing, as the slip D of an expression does; "
    "leave it out, or use one of the slip weakening laws, of which steady sliding has "
    "the kinetic coefficient");
  require(
    std::isfinite(result.coefficient),
    "has no coefficient at the speed of the flat and the pressure of the static state");
  result.slopes.rate = law.slope(at);
  if (at.pressure > 0.)
    result.slopes.pressure = (law.coefficient(moved(&SlipPoint::pressure, 1. + width)) -
                              law.coefficient(moved(&SlipPoint::pressure, 1. - width))) /
                             (2. * width);
  if (!law.state() || !std::isfinite(at.state))
    return result;
  const auto steady = [&](const double factor) {
    SlipPoint other = moved(&SlipPoint::slip_rate, factor);
    other.state     = law.steady_state(other.slip_rate);
    return law.coefficient(other);
  };
  result.slopes.state =
    (steady(1. + width) - steady(1. - width)) / (2. * width * at.slip_rate) -
    result.slopes.rate;
  result.state_time = return_time(law, at.state, at.slip_rate);
  require(std::isfinite(result.state_time) && result.state_time > 0.,
          "has a state that does not return to its steady value");
  return result;
}
} // namespace mesoslip
