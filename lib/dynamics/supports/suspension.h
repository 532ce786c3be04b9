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
 * What is between a side and a far end: springs and dashpots for the area (in 2D: for the length and a
 * thickness of one), and a mass that moves with the side; and a traction. Components are x, y and z, in 2D x and y.
 */
struct Suspension
{
  std::array<double, 3> stiffness = {}; ///< of the springs (Pa/m)
  std::array<double, 3> dashpot   = {}; ///< Pa s/m
  double mass                     = 0.; ///< kg/m^2
  std::array<LoadHistory, 3> motion;    ///< displacement of the far end (m)
  Traction traction;                    ///< on the side besides
  bool absorbing = false; ///< dashpots have the impedances of the phases behind the side

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

  /** Square of the circular frequency (1/s^2) of nodes of this mass for their area (kg/m^2) on the
   * stiffest of the springs. */
  double squared_frequency(const double mass_of_area) const
  {
    return *std::max_element(stiffness.begin(), stiffness.end()) / (mass_of_area + mass);
  }

  /** Time in which a rigid body of this mass for the area (kg/m^2) swings on the softest of the springs (s);
   * 0 without springs. */
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

  /** Whether there is anything. */
  bool is_there() const
  {
    return is_suspended() || traction.is_there();
  }
};

/** Share of the acceleration of a step in the velocity w_n + theta dt a_n that a dashpot acts on; see SuspendedNodes,
 * @p z is its damping constant times dt over the mass. */
inline double dashpot_theta(const double z)
{
  return z > 2. ? 1. - 1. / z : 0.5;
}

/** Share of a dashpot that counts in the acceleration at the start: none of those that stop the mass within a step. */
inline double dashpot_at_start(const double z)
{
  return z > 2. ? 4. / (z * z) : 1.;
}

/** The far end at the time of step n. */
template <int dim>
struct FarEnd
{
  std::array<double, dim> before = {}; ///< its displacement at step n - 1 (m)
  std::array<double, dim> now    = {}; ///< at step n
  std::array<double, dim> after  = {}; ///< at step n + 1
  std::array<double, dim> velocity =
    {}; ///< half of what it moves from before to after, over dt

  /** Of the motion of @p suspension; before the start it moves as in the first step. */
  FarEnd(const Suspension &suspension, const double time, const double dt)
  {
    for (unsigned int c = 0; c < dim; ++c)
      {
        const LoadHistory &motion = suspension.motion[c];
        if (!motion.is_expression()) // at rest
          continue;
        now[c]    = motion(time);
        after[c]  = motion(time + dt);
        before[c] = time > 0. ? motion(std::max(0., time - dt)) : 2. * now[c] - after[c];
        velocity[c] = (after[c] - before[c]) / (2. * dt);
      }
  }

  /** How far component @p c moves in the central increment of step n (m). */
  double moved(const unsigned int c) const
  {
    return 0.5 * (after[c] - before[c]);
  }
};

/** Energies of a suspension, of one rank (J, in 2D J/m). */
struct SuspensionEnergies
{
  double stored   = 0.; ///< now, in springs and as kinetic energy of the mass
  double at_start = 0.; ///< the same at the start
  double lost     = 0.; ///< since the start, in dashpots and by damping of the mass

  /** Adds those of others. */
  SuspensionEnergies &operator+=(const SuspensionEnergies &other)
  {
    stored += other.stored;
    at_start += other.at_start;
    lost += other.lost;
    return *this;
  }

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &stored &at_start &lost;
  }
};
} // namespace mesoslip

#endif
