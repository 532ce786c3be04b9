#ifndef mesoslip_dynamics_side_support_h
#define mesoslip_dynamics_side_support_h

#include "dynamics/supports/suspension.h"

#include <array>
#include <string>

namespace mesoslip
{
/** What holds and loads a side of the body. */
struct SideSupport
{
  std::string name; ///< Left, Right, Front, Back or Top of a grid, or a group of a mesh
  std::array<bool, 3> held = {}; ///< components that do not move: x, y, z
  LoadHistory pressure;          ///< Pa, positive when it presses into the body
  Suspension suspension;         ///< to a far end

  /** The nodes move as one: along the normal, and across it where there are springs. */
  bool is_platen = false;

  double platen_mass = 0.; ///< of the platen (kg, in 2D kg/m)

  /** Whether any component is held. */
  bool holds() const
  {
    return held != std::array<bool, 3>{};
  }

  /** Whether its nodes feel anything besides the forces of the body. */
  bool is_loaded() const
  {
    return is_platen || suspension.is_there() || pressure.is_expression() ||
           pressure.amplitude() != 0.;
  }

  /** Whether it keeps energy: in springs, or as kinetic energy of what moves with the body. */
  bool keeps_energy() const
  {
    return suspension.is_there() || platen_mass > 0.;
  }

  std::string section; ///< its path; empty: Supports/ and the name

  /** Path of a key in its section. */
  std::string key(const std::string &of_section) const
  {
    return (section.empty() ? "Supports/" + name : section) + "/" + of_section;
  }
};
} // namespace mesoslip

#endif
