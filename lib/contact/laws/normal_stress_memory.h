#ifndef mesoslip_contact_laws_normal_stress_memory_h
#define mesoslip_contact_laws_normal_stress_memory_h

#include "contact/laws/relaxation.h"

namespace mesoslip
{
/**
 * Friction that does not follow the normal stress at once (Prakash and Clifton 1993, Prakash
 * 1998), in the form with a relaxed normal stress sigma* (Rubin and Ampuero 2007): the limit
 * of friction is mu sigma* with
 *
 *     d sigma* / dt = -(sigma* - sigma) / t_pc,   t_pc = L / (|V_rel| + V_ref) or constant
 */
struct NormalStressMemory
{
  double time               = 0.; ///< t_pc (s); 0: by the length
  double length             = 0.; ///< L (m); 0: by the time
  double reference_velocity = 0.; ///< V_ref (m/s), so that t_pc stays finite at rest

  /** Whether there is any; otherwise sigma* = sigma, which costs nothing. */
  bool is_given() const
  {
    return time > 0. || length > 0.;
  }

  /** A step of @p dt (s) of a node that slides with @p slip_rate (m/s). */
  Relaxation step(const double dt, const double slip_rate) const
  {
    return {dt, length > 0. ? length / (slip_rate + reference_velocity) : time};
  }
};
} // namespace mesoslip

#endif
