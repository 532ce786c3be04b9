#ifndef mesoslip_contact_laws_relaxation_h
#define mesoslip_contact_laws_relaxation_h

#include <cmath>

namespace mesoslip
{
/**
 * One step of d f / dt = -(f - target) / delta, solved exactly for a target that changes
 * linearly in time during the step:
 *
 *     f_new = target_new + decay (f - target) - lag (target_new - target)
 */
struct Relaxation
{
  /** A step of length @p dt (s) with the time @p delta (s); 0: f follows its target. */
  Relaxation(const double dt, const double delta)
  {
    if (!(delta > 0.))
      return;
    // expm1 keeps its digits for small x.
    const double x = dt / delta, relaxed = -std::expm1(-x);
    decay = 1. - relaxed;
    lag   = x > 0. ? relaxed / x : 1.;
  }

  double decay = 0.; ///< exp(-dt / delta)
  double lag   = 0.; ///< (1 - decay) delta / dt
};
} // namespace mesoslip

#endif
