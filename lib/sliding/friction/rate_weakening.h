#ifndef mesoslip_sliding_friction_rate_weakening_h
#define mesoslip_sliding_friction_rate_weakening_h

#include <limits>
#include <string>

namespace mesoslip
{
/**
 * Compares the fall of friction with the slip rate to the radiation of shear waves. If r
 * = fall / impedance > 1, vibrations of a body without delta and beta grow in proportion
 * to their wave number: a half-space under waves across the motion by k c_T / sqrt(r^2 -
 * 1), cells of height h by 2 c_T sqrt(r^2 - 1) / h. Springs along the flat take fall /
 * stiffness from delta; if less than nothing is left, they slip away by themselves.
 */
struct RateWeakening
{
  double fall      = 0.; ///< largest -p d mu/d V at constant state of the law (Pa s/m)
  double impedance = 0.; ///< shear_impedance() of the body (Pa s/m)
  double delta     = 0.; ///< regularization time (s)
  double beta      = 0.; ///< Rayleigh beta (s)
  double stiffness =
    std::numeric_limits<double>::infinity(); ///< tangential contact stiffness (Pa/m)

  /** delta - fall / stiffness (s). */
  double lag() const
  {
    return delta - fall / stiffness;
  }

  /** Whether friction falls by more than waves radiate, or than springs with delta take. */
  bool is_too_steep() const
  {
    return fall > 0. && (!(fall < impedance) || lag() < 0.);
  }

  /** Upper bound (1/s) of the growth rate of vibrations of any length where friction is
   * too steep: the s with sqrt(1 + beta s) (1 + lag() s) = r, 1 / |lag()| where this is
   * negative; infinite without it and beta. */
  double fastest_growth() const;

  /** "falls by up to 7e6 Pa s/m with the slip rate @p where, more than the 5e6 Pa s/m
   * that shear waves into the body resist (density times wave speed)", or that springs
   * with the regularization time take */
  std::string text(const std::string &where) const;
};
} // namespace mesoslip

#endif
