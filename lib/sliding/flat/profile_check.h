#ifndef mesoslip_sliding_profile_check_h
#define mesoslip_sliding_profile_check_h

#include "sliding/body_size.h"
#include "sliding/contact_parameters.h"

#include <array>
#include <string>
#include <vector>

namespace mesoslip
{
/** Where the nodes of the contact are before the first step. */
struct ContactPlaces
{
  const std::array<std::vector<double>, 2> &place; ///< x and, in 3D, y (m)
  const std::vector<double> &height; ///< above the lowest (m); empty: all are as high
  double spacing = 0.;               ///< about, between neighbours (m)
};

/**
 * Looks at the profile of the flat wherever it comes below the body on its way; warnings on what cannot be trusted of it.
 * @throws UserError for one that is not finite, too steep, into the body at the start, or not the same below both
 * sides of a periodic body
 */
std::vector<std::string> look_at_profile(const ContactParameters &parameters,
                                         const BodyScales &body,
                                         const ContactPlaces &nodes);

/** Gaps of the nodes (m), less the least of them at the start, after the flat has moved by @p way (m) and the nodes along
 * it by @p displaced (m, their dim - 1 components together; empty: not). */
std::vector<double> gaps_over_profile(const FlatProfile &profile,
                                      const ContactPlaces &nodes,
                                      const std::array<double, 2> &way,
                                      const std::vector<double> &displaced);
} // namespace mesoslip

#endif
