#ifndef mesoslip_contact_laws_power_spring_h
#define mesoslip_contact_laws_power_spring_h

#include <cmath>

namespace mesoslip
{
/**
 * Springs between body and flat with pressure p = at (g / g_0)^exponent at compression g;
 * g_0 gives the stiffness dp/dg = stiffness at the pressure p = at. Rough surfaces have
 * exponents of 2 to 3.3.
 */
struct PowerSpring
{
  double stiffness = 0.; ///< dp/dg at pressure at, or constant with exponent 1 (Pa/m)
  double exponent  = 1.; ///< at least 1
  double at        = 0.; ///< pressure (Pa), not used with exponent 1

  /** Whether the stiffness is constant. */
  bool is_linear() const
  {
    return exponent == 1.;
  }

  /** g_0 (m). */
  double scale() const
  {
    return exponent * at / stiffness;
  }

  /** p (Pa) at @p depth >= 0 (m). */
  double pressure(const double depth) const
  {
    return is_linear() ? stiffness * depth : at * std::pow(depth / scale(), exponent);
  }

  /** dp/dg (Pa/m) at @p depth >= 0 (m). */
  double tangent(const double depth) const
  {
    return is_linear() ? stiffness : stiffness * std::pow(depth / scale(), exponent - 1.);
  }

  /** The integral of p (J/m^2) up to @p depth >= 0 (m). */
  double energy(const double depth) const
  {
    return pressure(depth) * depth / (exponent + 1.);
  }

  /** g (m) under @p pressed >= 0 (Pa). */
  double depth_under(const double pressed) const
  {
    return is_linear() ? pressed / stiffness
                       : scale() * std::pow(pressed / at, 1. / exponent);
  }
};
} // namespace mesoslip

#endif
