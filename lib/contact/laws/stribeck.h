#ifndef mesoslip_contact_laws_stribeck_h
#define mesoslip_contact_laws_stribeck_h

#include "contact/laws/nodewise_law.h"

#include <cmath>

namespace mesoslip
{
/**
 * Static and kinetic coefficient with a Stribeck curve and a viscous term,
 *
 *     mu = mu_k + (mu_s - mu_k) exp(-(V / V_c)^n) + c V
 *
 * (Bo and Pavelescu 1982, Armstrong-Helouvry et al. 1994); n = 1, c = 0 is exponential
 * decay.
 */
class Stribeck final : public NodewiseLaw<Stribeck>
{
public:
  /** Constants of the law. */
  struct Constants
  {
    double at_rest           = 0.; ///< mu_s
    double kinetic           = 0.; ///< mu_k; above mu_s friction rises with V
    double critical_velocity = 1.; ///< V_c > 0 (m/s)
    double exponent          = 1.; ///< n >= 1
    double viscous           = 0.; ///< c >= 0 (s/m)
  };

  /** Uses @p constants. */
  explicit Stribeck(const Constants &constants)
    : c(constants)
  {
  }

  double coefficient(const SlipPoint &at) const override
  {
    return c.kinetic + (c.at_rest - c.kinetic) * std::exp(-power(at.slip_rate)) +
           c.viscous * at.slip_rate;
  }

  double slope(const SlipPoint &at) const override
  {
    const double x = at.slip_rate / c.critical_velocity, y = power(at.slip_rate),
                 of_power = c.exponent == 1. ? 1.
                            : x > 0.         ? c.exponent * y / x
                                             : 0.;
    return (c.kinetic - c.at_rest) * std::exp(-y) * of_power / c.critical_velocity +
           c.viscous;
  }

  double largest(const double fastest) const override
  {
    return std::fmax(c.at_rest, c.kinetic) + c.viscous * fastest;
  }

  // exp(-x^n) is steepest where x^n = (n - 1) / n.
  double steepest_fall() const override
  {
    const double y    = (c.exponent - 1.) / c.exponent,
                 fall = c.exponent * std::pow(y, y) * std::exp(-y) / c.critical_velocity;
    return std::fmax(0., (c.at_rest - c.kinetic) * fall - c.viscous);
  }

private:
  double power(const double slip_rate) const
  {
    const double x = slip_rate / c.critical_velocity;
    return c.exponent == 1. ? x : std::pow(x, c.exponent);
  }

  const Constants c;
};
} // namespace mesoslip

#endif
