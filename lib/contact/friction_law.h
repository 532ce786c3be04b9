#ifndef mesoslip_contact_friction_law_h
#define mesoslip_contact_friction_law_h

namespace mesoslip
{
/**
 * Coulomb friction with the tangential traction relaxing to its limit,
 * d sigma_t / dt = -(sigma_t - sign mu |sigma_n|) / delta (eq. 7).
 */
struct FrictionLaw
{
  enum class Regularization
  {
    none,          ///< plain Coulomb, delta = 0
    constant_time, ///< delta given
    slip_rate      ///< delta = L / (|V_rel| + V_ref)
  };

  Regularization regularization = Regularization::constant_time;

  /** delta (s), for constant_time. */
  double time = 1.5e-6;

  /** L (m), for slip_rate. */
  double length = 3e-6;

  /** V_ref (m/s), for slip_rate. */
  double reference_velocity = 1e-3;
};
} // namespace mesoslip

#endif
