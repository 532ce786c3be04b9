#ifndef mesoslip_sliding_supports_load_keys_h
#define mesoslip_sliding_supports_load_keys_h

#include "dynamics/supports/side_support.h"

#include <string>

namespace mesoslip
{
class Keys;

/**
 * Binds Ramp, Ramp time and Expression of a load in the current section; @p what is its
 * name and @p unit its unit in texts. The key of its amplitude is already bound.
 * @throws UserError for an expression that cannot be read or is infinite at the start
 */
LoadHistory bind_history(Keys &keys,
                         const double amplitude,
                         const std::string &what,
                         const std::string &unit);

/** Binds springs, dashpots, mass and far-end motion of @p side, such as "the top".
 * @throws UserError for more components than the body has, and for a motion that cannot
 * be read */
void bind_suspension(Keys &keys,
                     Suspension &suspension,
                     const std::string &side,
                     const unsigned int dim);

/** Binds the mass of a platen; @p what is its place in texts, such as "the top". */
void bind_platen_mass(Keys &keys, SideSupport &side, const std::string &what);
} // namespace mesoslip

#endif
