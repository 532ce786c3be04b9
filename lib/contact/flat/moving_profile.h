#ifndef mesoslip_contact_moving_profile_h
#define mesoslip_contact_moving_profile_h

#include "contact/contact_kernel.h"
#include "contact/flat/flat_profile.h"
#include "dynamics/surface_condition.h"

#include <array>
#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * The flat below the contact nodes while it moves along itself: the gap of each node in a step is that to the place
 * of the flat where the node is going to be, its displacement along the flat extrapolated from the step before.
 */
template <int dim>
class MovingProfile
{
public:
  /** Nodes at @p position (x and, in 3D, y, m) and @p heights (m) over the plane of a flat with the profile @p given; one
   * that is infinitely high is no node. */
  MovingProfile(std::shared_ptr<const FlatProfile> given,
                const std::array<std::vector<double>, 2> &position,
                const std::vector<double> &heights);

  /** The gaps (m) before the first step of a body that is not displaced. */
  void start(double *gap) const;

  /** What the flat rose by below the nodes before the first step, in which it moved by @p moved (m) and the nodes by
   * the increments in @p contact. */
  void start_rise(const std::array<double, 2> &moved, const ContactArrays &contact) const;

  /** Gaps and rises in @p contact for the step in which the flat moves by @p moved (m). */
  void advance(const SurfaceView<dim> &surface,
               const std::array<double, 2> &moved,
               const ContactArrays &contact);

  /** Saves or restores the state between two steps (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &way[0] & way[1];
  }

private:
  const std::shared_ptr<const FlatProfile> profile;
  std::vector<unsigned int> nodes; ///< numbers of those that are not infinitely high
  std::array<std::vector<double>, 2> place; ///< x and y of each of them at the start (m)
  std::vector<double> height;               ///< likewise, over the plane of the flat (m)
  std::array<double, 2> way = {};           ///< of the flat since the start (m)
};
} // namespace mesoslip

#endif
