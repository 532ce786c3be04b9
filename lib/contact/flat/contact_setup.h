#ifndef mesoslip_contact_flat_contact_setup_h
#define mesoslip_contact_flat_contact_setup_h

#include "contact/flat/flat_profile.h"
#include "contact/flat/power_springs.h"
#include "contact/friction_law.h"
#include "contact/laws/slip_law.h"
#include "parameters/load_history.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace mesoslip
{
/** The rigid flat. */
struct ContactSetup
{
  FrictionLaw law; ///< target, limit and regularization of the tangential force

  /** Coulomb coefficient of each node of the surface. */
  std::vector<double> friction_coefficient;

  /** Velocity of the flat along flat_direction (m/s). */
  LoadHistory flat_velocity;

  /** Along x and y, of length one; x in 2D. */
  std::array<double, 2> flat_direction = {{1., 0.}};

  /** Distance between surface and plane of the flat in the undeformed state (m). */
  double gap = 0.;

  /** Height of the flat over its plane; null: it is even. */
  std::shared_ptr<const FlatProfile> profile;

  /** Springs between surface and flat; of infinite stiffness: there are none. */
  PowerSpring normal_spring = {std::numeric_limits<double>::infinity(), 1., 0.};

  /** Of springs along the flat, through which it drags the surface, for the area (Pa/m); infinite: there are none. */
  double tangential_stiffness = std::numeric_limits<double>::infinity();

  /** Of each node above the lowest of them in the undeformed state (m); empty: all are
   * equally high. */
  std::vector<double> height;

  /** The last node duplicates the first. */
  bool periodic = false;

  /** Tributary length (m, in 3D m^2) of each node, for springs and laws with a pressure. */
  std::vector<double> area;

  /** x and, in 3D, y (m) of each node, for laws with a place and profiles. */
  std::array<std::vector<double>, 2> position;

  /** Whether there are springs. */
  bool is_compliant() const
  {
    return std::isfinite(normal_spring.stiffness);
  }

  /** Whether nodes take part in more than linear springs along the normal of an even flat. */
  bool is_full() const
  {
    return profile || is_coupled || slips_on_springs() ||
           (is_compliant() && !normal_spring.is_linear());
  }

  /** Forces reach neighbours through the surface below, or it rises and falls under the nodes, see ContactSurface::ride(). */
  bool is_coupled = false;

  /** Whether there are springs along the flat. */
  bool slips_on_springs() const
  {
    return std::isfinite(tangential_stiffness);
  }

  /** Whether area and place of the nodes are needed. */
  bool wants_area() const
  {
    return is_compliant() || slips_on_springs() || profile ||
           (law.slip_law && law.slip_law->looks_around());
  }

  /** The first nodes, which this rank owns; those from the next whole vector on are copies
   * (SharedNodes). Not given: all. */
  std::optional<unsigned int> n_owned;
};
} // namespace mesoslip

#endif
