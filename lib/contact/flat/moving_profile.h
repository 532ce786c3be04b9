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
 * Profile of the flat below the contact nodes while it moves along itself. The gap of a
 * node in a step is evaluated at the predicted position of the node on the flat; its
 * tangential displacement is extrapolated from the previous step.
 */
template <int dim>
class MovingProfile
{
public:
  /**
   * Nodes at @p position (x and, in 3D, y, m) and @p heights (m) over the plane of a flat
   * with the profile @p given; an infinite height marks padding.
   */
  MovingProfile(std::shared_ptr<const FlatProfile> given,
                const std::array<std::vector<double>, 2> &position,
                const std::vector<double> &heights);

  /** Gaps (m) of the undeformed body before the first step. */
  void start(double *gap) const;

  /**
   * Sets the rise of the flat below the nodes before the first step, in which the flat
   * moved by @p moved (m) and the nodes by the increments in @p contact.
   */
  void start_rise(const std::array<double, 2> &moved, const ContactArrays &contact) const;

  /**
   * Sets gaps and rises in @p contact for the step in which the flat moves by @p moved
   * (m).
   */
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
  std::vector<unsigned int> nodes;          ///< indices of the nodes with finite height
  std::array<std::vector<double>, 2> place; ///< initial x and y of each of nodes (m)
  std::vector<double> height;               ///< height of nodes over the plane (m)
  std::array<double, 2> way = {};           ///< displacement of the flat (m)
};
} // namespace mesoslip

#endif
