#ifndef mesoslip_contact_laws_rate_and_state_h
#define mesoslip_contact_laws_rate_and_state_h

#include "contact/laws/nodewise_law.h"

#include <cmath>

namespace mesoslip
{
/**
 * Friction of rate V and state theta (Dieterich 1979, Ruina 1983), regularized so that it is
 * zero at rest (Rice, Lapusta and Ranjith 2001),
 *
 *     mu = a asinh( V / (2 V_0) exp((f_0 + b ln(V_0 theta / L)) / a) )
 *     d theta / dt = 1 - V theta / L                       aging law
 *     d theta / dt = -(V theta / L) ln(V theta / L)        slip law
 *
 * A step takes V for constant and is exact for it. Off the flat theta begins anew.
 */
class RateAndState final : public NodewiseLaw<RateAndState>
{
public:
  /** The constants. */
  struct Constants
  {
    double reference     = 0.;    ///< f_0 > 0, steady friction at V_0
    double a             = 0.01;  ///< of the direct effect, > 0
    double b             = 0.015; ///< of the evolution
    double length        = 1e-5;  ///< L > 0 (m)
    double velocity      = 1e-6;  ///< V_0 > 0 (m/s)
    double initial_state = 10.;   ///< theta of a node that begins to touch, > 0 (s)
    bool aging           = true;  ///< else the slip law
  };

  /** With these. */
  explicit RateAndState(const Constants &constants)
    : c(constants)
  {
  }

  double coefficient(const SlipPoint &at) const override
  {
    // asinh(exp(x)); the exponential may be beyond all numbers.
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
    if (c.aging)                                          // dt (1 - exp(-x)) / x comes in
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

  // Of a node that has just come down; the aging law makes it stronger without an end.
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
