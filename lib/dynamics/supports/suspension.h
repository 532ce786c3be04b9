#ifndef mesoslip_dynamics_suspension_h
#define mesoslip_dynamics_suspension_h

#include "dynamics/supports/traction.h"
#include "parameters/load_history.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace mesoslip
{
/**
 * Suspension of a side to a far end: springs and dashpots per area (in 2D per length and
 * unit thickness), a mass that moves with the side, and a traction. Components are x, y
 * and z, in 2D x and y.
 */
struct Suspension
{
  std::array<double, 3> stiffness = {}; ///< springs (Pa/m)
  std::array<double, 3> dashpot   = {}; ///< dashpots (Pa s/m)
  double mass                     = 0.; ///< kg/m^2
  std::array<LoadHistory, 3> motion;    ///< displacement of the far end (m)
  Traction traction;                    ///< additional traction on the side
  bool absorbing = false; ///< dashpots have the impedances of the phases at the side

  /** Whether there are springs. */
  bool has_springs() const
  {
    return stiffness != std::array<double, 3>{};
  }

  /** Whether springs or dashpots act along component @p c. */
  bool resists(const unsigned int c) const
  {
    return stiffness[c] > 0. || dashpot[c] > 0. || absorbing;
  }

  /**
   * Squared circular frequency (1/s^2) of nodes with this mass per area (kg/m^2) on the
   * stiffest spring.
   */
  double squared_frequency(const double mass_of_area) const
  {
    return *std::max_element(stiffness.begin(), stiffness.end()) / (mass_of_area + mass);
  }

  /**
   * Period of a rigid body with this mass per area (kg/m^2) on the softest spring (s); 0
   * without springs.
   */
  double period(const double mass_of_area) const
  {
    double softest = 0.;
    for (const double k : stiffness)
      if (k > 0. && (softest == 0. || k < softest))
        softest = k;
    return softest > 0. ? 2. * M_PI * std::sqrt((mass_of_area + mass) / softest) : 0.;
  }

  /** Whether there are springs, dashpots or a mass. */
  bool is_suspended() const
  {
    return has_springs() || dashpot != std::array<double, 3>{} || mass > 0. || absorbing;
  }

  /** Whether there are springs, dashpots, a mass or a traction. */
  bool is_there() const
  {
    return is_suspended() || traction.is_there();
  }
};

/**
 * theta in the velocity w_n + theta dt a_n of a dashpot, see SuspendedNodes; @p z is the
 * damping constant times dt over the mass.
 */
inline double dashpot_theta(const double z)
{
  return z > 2. ? 1. - 1. / z : 0.5;
}

/**
 * Factor of a dashpot in the initial acceleration; small for dashpots that stop the mass
 * within a step.
 */
inline double dashpot_at_start(const double z)
{
  return z > 2. ? 4. / (z * z) : 1.;
}

/** Motion of the far end around step n. */
template <int dim>
struct FarEnd
{
  std::array<double, dim> before   = {}; ///< displacement at step n - 1 (m)
  std::array<double, dim> now      = {}; ///< displacement at step n (m)
  std::array<double, dim> after    = {}; ///< displacement at step n + 1 (m)
  std::array<double, dim> velocity = {}; ///< (after - before) / (2 dt) (m/s)

  /**
   * Far end of @p suspension at @p time; before the start it moves as in the first step.
   */
  FarEnd(const Suspension &suspension, const double time, const double dt)
  {
    for (unsigned int c = 0; c < dim; ++c)
      {
        const LoadHistory &motion = suspension.motion[c];
        if (!motion.is_expression()) // far end at rest
          continue;
        now[c]    = motion(time);
        after[c]  = motion(time + dt);
        before[c] = time > 0. ? motion(std::max(0., time - dt)) : 2. * now[c] - after[c];
        velocity[c] = (after[c] - before[c]) / (2. * dt);
      }
  }

  /** Displacement of component @p c in the central increment of step n (m). */
  double moved(const unsigned int c) const
  {
    return 0.5 * (after[c] - before[c]);
  }
};

/** Energies of a suspension on one rank (J, in 2D J/m). */
struct SuspensionEnergies
{
  double stored   = 0.; ///< current energy of springs and kinetic energy of the mass
  double at_start = 0.; ///< stored at the start
  double lost     = 0.; ///< dissipated since the start, also by alpha

  /** Adds the energies of @p other. */
  SuspensionEnergies &operator+=(const SuspensionEnergies &other)
  {
    stored += other.stored;
    at_start += other.at_start;
    lost += other.lost;
    return *this;
  }

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &stored &at_start &lost;
  }
};
} // namespace mesoslip

#endif
