#ifndef mesoslip_sliding_profile_check_h
#define mesoslip_sliding_profile_check_h

#include "sliding/body_size.h"
#include "sliding/contact_parameters.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** Initial positions of the contact nodes. */
struct ContactPlaces
{
  const std::array<std::vector<double>, 2> &place; ///< x and, in 3D, y (m)
  const std::vector<double> &height; ///< above the lowest (m); empty: all equal
  double spacing = 0.;               ///< approximate distance between neighbours (m)
};

/**
 * Checks the profile of the flat wherever it passes below the body.
 * @return warnings on unreliable parts.
 * @throws UserError for a profile that is not finite, too steep, in the body at the
 * start, or different below the two sides of a periodic body
 */
std::vector<std::string> look_at_profile(const ContactParameters &parameters,
                                         const BodyScales &body,
                                         const ContactPlaces &nodes);

/** Gaps of the nodes (m), minus the least initial gap, after the flat has moved by @p way
 * (m) and the nodes by @p displaced along the flat (m, dim - 1 components per node;
 * empty: zero). */
std::vector<double> gaps_over_profile(const FlatProfile &profile,
                                      const ContactPlaces &nodes,
                                      const std::array<double, 2> &way,
                                      const std::vector<double> &displaced);
} // namespace mesoslip

#endif
