#ifndef mesoslip_contact_laws_normal_stress_memory_h
#define mesoslip_contact_laws_normal_stress_memory_h

#include "contact/laws/relaxation.h"

namespace mesoslip
{
/**
 * Memory of the normal stress in friction (Prakash and Clifton 1993, Prakash 1998), in
 * the form with a relaxed normal stress sigma* (Rubin and Ampuero 2007): the limit of
 * friction is mu sigma* with
 *
 *     d sigma* / dt = -(sigma* - sigma) / t_pc,   t_pc = L / (|V_rel| + V_ref) or constant
 */
struct NormalStressMemory
{
  double time               = 0.; ///< t_pc (s); 0: use length
  double length             = 0.; ///< L (m); 0: use time
  double reference_velocity = 0.; ///< V_ref (m/s), keeps t_pc finite at rest

  /** Whether there is a memory; otherwise sigma* = sigma. */
  bool is_given() const
  {
    return time > 0. || length > 0.;
  }

  /** Relaxation in a step of @p dt (s) for a node that slides with @p slip_rate (m/s). */
  Relaxation step(const double dt, const double slip_rate) const
  {
    return {dt, length > 0. ? length / (slip_rate + reference_velocity) : time};
  }
};
} // namespace mesoslip

#endif
