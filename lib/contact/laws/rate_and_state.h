#ifndef mesoslip_contact_laws_rate_and_state_h
#define mesoslip_contact_laws_rate_and_state_h

#include "contact/laws/nodewise_law.h"

#include <cmath>

namespace mesoslip
{
/**
 * Rate-and-state friction with slip rate V and state theta (Dieterich 1979, Ruina 1983),
 * regularized so that it is zero at rest (Rice, Lapusta and Ranjith 2001),
 *
 *     mu = a asinh( V / (2 V_0) exp((f_0 + b ln(V_0 theta / L)) / a) )
 *     d theta / dt = 1 - V theta / L                       aging law
 *     d theta / dt = -(V theta / L) ln(V theta / L)        slip law
 *
 * A step assumes constant V and is exact for it. After separation theta is reset.
 */
class RateAndState final : public NodewiseLaw<RateAndState>
{
public:
  /** Constants of the law. */
  struct Constants
  {
    double reference     = 0.;    ///< f_0 > 0, steady coefficient at V_0
    double a             = 0.01;  ///< direct effect, > 0
    double b             = 0.015; ///< evolution effect
    double length        = 1e-5;  ///< L > 0 (m)
    double velocity      = 1e-6;  ///< V_0 > 0 (m/s)
    double initial_state = 10.;   ///< theta of a node at first contact, > 0 (s)
    bool aging           = true;  ///< aging law; else slip law
  };

  /** Uses @p constants. */
  explicit RateAndState(const Constants &constants)
    : c(constants)
  {
  }

  double coefficient(const SlipPoint &at) const override
  {
    // asinh(exp(x)) without overflow of the exponential.
    const double x = argument(at);
    return c.a * (x > 20. ? x + M_LN2 : std::asinh(std::exp(x)));
  }

  double slope(const SlipPoint &at) const override
  {
    const double x = argument(at);
    return at.slip_rate > 0.
             ? c.a / (at.slip_rate * std::sqrt(1. + std::exp(-2. * x)))
             : c.a / (2. * c.velocity) * std::exp(strength(at.state) / c.a);
  }

  std::optional<StateVariable> state() const override
  {
    return StateVariable{"theta", "s", c.initial_state};
  }

  double next_state(const double state, const SlipStep &step) const override
  {
    if (!step.touches)
      return c.initial_state;
    const double x = step.slip_rate * step.dt / c.length; // slip over L
    if (c.aging)                                          // adds dt (1 - exp(-x)) / x
      return state * std::exp(-x) + step.dt * (x > 0. ? -std::expm1(-x) / x : 1.);
    if (!(x > 0.))
      return state;
    const double steady = c.length / step.slip_rate;
    return steady * std::exp(std::log(state / steady) * std::exp(-x));
  }

  double steady_state(const double slip_rate) const override
  {
    return slip_rate > 0. ? c.length / slip_rate : c.initial_state;
  }

  // Value of a node that has just landed; with the aging law, friction grows without
  // bound in time.
  double largest(const double fastest) const override
  {
    SlipPoint at;
    at.slip_rate = fastest;
    at.state     = std::fmax(c.initial_state, steady_state(fastest));
    return coefficient(at);
  }

  double steepest_fall_in_slip() const override
  {
    return c.b / c.length;
  }

private:
  double strength(const double theta) const
  {
    return c.reference + c.b * std::log(c.velocity * theta / c.length);
  }

  double argument(const SlipPoint &at) const
  {
    return std::log(at.slip_rate / (2. * c.velocity)) + strength(at.state) / c.a;
  }

  const Constants c;
};
} // namespace mesoslip

#endif
