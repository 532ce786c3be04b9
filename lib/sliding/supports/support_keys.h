#ifndef mesoslip_sliding_supports_support_keys_h
#define mesoslip_sliding_supports_support_keys_h

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

/** Differences between the sections of supports. */
struct SupportDefaults
{
  std::string kind = "free"; ///< default of Kind
  double pressure  = 0.;     ///< default of Pressure (Pa)

  /** Whether it is the top: along the normal of the flat it is held with Kind = held
   * only, and Pressure may be 0. */
  bool is_top = false;

  bool needs_pressure = true; ///< whether a Pressure without effect is refused
};

/** Binds the support in section @p name of the current section: Left, Right, Front, Back,
 * Top, Bottom or a mesh group.
 * @throws UserError for keys that have no effect or contradict each other */
SideSupport bind_support(Keys &keys,
                         const std::string &name,
                         const unsigned int dim,
                         const SupportDefaults &defaults = {});
} // namespace mesoslip

#endif
