#ifndef mesoslip_dynamics_side_support_h
#define mesoslip_dynamics_side_support_h

#include "dynamics/supports/suspension.h"

#include <array>
#include <string>

namespace mesoslip
{
/** Constraints and loads of a side of the body. */
struct SideSupport
{
  std::string name; ///< Left, Right, Front, Back or Top of a grid, or a mesh group
  std::array<bool, 3> held = {}; ///< constrained components: x, y, z
  LoadHistory pressure;          ///< Pa, positive if it presses into the body
  Suspension suspension;         ///< suspension to a far end

  /**
   * Whether the nodes move as a rigid unit: along the normal, and tangentially if there
   * are springs.
   */
  bool is_platen = false;

  double platen_mass = 0.; ///< mass of the platen (kg, in 2D kg/m)

  /** Whether any component is constrained. */
  bool holds() const
  {
    return held != std::array<bool, 3>{};
  }

  /** Whether forces other than body forces act on its nodes. */
  bool is_loaded() const
  {
    return is_platen || suspension.is_there() || pressure.is_expression() ||
           pressure.amplitude() != 0.;
  }

  /** Whether it stores energy, in springs or as kinetic energy of an attached mass. */
  bool keeps_energy() const
  {
    return suspension.is_there() || platen_mass > 0.;
  }

  std::string section; ///< path of the section; empty: Supports/ and the name

  /** Path of a key in the section. */
  std::string key(const std::string &of_section) const
  {
    return (section.empty() ? "Supports/" + name : section) + "/" + of_section;
  }
};
} // namespace mesoslip

#endif
