#ifndef mesoslip_contact_flat_contact_setup_h
#define mesoslip_contact_flat_contact_setup_h

#include "contact/flat/flat_profile.h"
#include "contact/flat/power_springs.h"
#include "contact/friction_law.h"
#include "contact/laws/coefficient_law.h"
#include "parameters/load_history.h"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace mesoslip
{
/** Parameters of the contact with a rigid flat. */
struct ContactSetup
{
  FrictionLaw law; ///< limit, target and regularization of friction

  /** Coulomb coefficient of each node of the surface. */
  std::vector<double> friction_coefficient;

  /** Velocity of the flat along flat_direction (m/s). */
  LoadHistory flat_velocity;

  /** Unit vector along x and y; x in 2D. */
  std::array<double, 2> flat_direction = {{1., 0.}};

  /** Distance between surface and plane of the flat in the undeformed state (m). */
  double gap = 0.;

  /** Height of the flat over its plane; null: the flat is even. */
  std::shared_ptr<const FlatProfile> profile;

  /** Normal springs between surface and flat; infinite stiffness: none. */
  PowerSpring normal_spring = {std::numeric_limits<double>::infinity(), 1., 0.};

  /**
   * Stiffness of tangential springs through which the flat drags the surface, per area
   * (Pa/m); infinite: none.
   */
  double tangential_stiffness = std::numeric_limits<double>::infinity();

  /**
   * Height of each node above the lowest one in the undeformed state (m); empty: equal
   * heights.
   */
  std::vector<double> height;

  /** Whether the last node is the periodic copy of the first. */
  bool periodic = false;

  /**
   * Tributary length (m, in 3D m^2) of each node, for springs and laws that depend on
   * pressure.
   */
  std::vector<double> area;

  /** x and, in 3D, y (m) of each node, for profiles and laws that depend on position. */
  std::array<std::vector<double>, 2> position;

  /** Whether there are normal springs. */
  bool is_compliant() const
  {
    return std::isfinite(normal_spring.stiffness);
  }

  /** Whether the contact needs more than linear normal springs and an even flat. */
  bool is_full() const
  {
    return profile || is_coupled || slips_on_springs() ||
           (is_compliant() && !normal_spring.is_linear());
  }

  /**
   * Whether forces affect neighbours through the surface below, or the surface rises and
   * falls under the nodes, see ContactSurface::ride().
   */
  bool is_coupled = false;

  /** Whether there are tangential springs. */
  bool slips_on_springs() const
  {
    return std::isfinite(tangential_stiffness);
  }

  /** Whether area and position of the nodes are needed. */
  bool wants_area() const
  {
    return is_compliant() || slips_on_springs() || profile ||
           (law.coefficient_law && law.coefficient_law->looks_around());
  }

  /**
   * Number of locally owned nodes, the first ones; ghost nodes start at the next whole
   * vector (SharedNodes). Empty: all nodes are owned.
   */
  std::optional<unsigned int> n_owned;
};
} // namespace mesoslip

#endif
