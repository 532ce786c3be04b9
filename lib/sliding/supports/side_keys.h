#ifndef mesoslip_sliding_supports_side_keys_h
#define mesoslip_sliding_supports_side_keys_h

#include "dynamics/supports/side_support.h"

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** The sides of a grid besides contact and top; along x, then y. */
extern const std::vector<std::string> sides_of_grid;

/** Whether @p name is in sides_of_grid. */
bool is_side_of_grid(const std::string &name);

/** Binds the support in section @p name; @p kind is the default of its Kind.
 * @throws UserError */
SideSupport bind_side(Keys &keys,
                      const std::string &name,
                      const unsigned int dim,
                      std::string kind = "free");
} // namespace mesoslip

#endif
