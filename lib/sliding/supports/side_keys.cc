#include "sliding/supports/side_keys.h"

#include "parameters/keys.h"
#include "sliding/supports/load_keys.h"

#include <algorithm>

namespace mesoslip
{
const std::vector<std::string> sides_of_grid = {"Left", "Right", "Front", "Back"};

bool is_side_of_grid(const std::string &name)
{
  return std::count(sides_of_grid.begin(), sides_of_grid.end(), name) > 0;
}

namespace
{
/** "side Front (lower y)", "group 'wall'". */
std::string text_of(const std::string &name)
{
  if (name == "Bottom")
    return "the bottom";
  if (!is_side_of_grid(name))
    return "group '" + name + "'";
  const bool lower = name == "Left" || name == "Front";
  return "side " + name + (lower ? " (lower " : " (upper ") +
         (name == "Left" || name == "Right" ? "x)" : "y)");
}

/** Binds the constrained components of a side; Kind = @p kind may constrain all. */
void bind_held(Keys &keys,
               SideSupport &side,
               const std::string &kind,
               const unsigned int dim)
{
  const std::vector<std::string> names = {"u_x", "u_y", "u_z"};
  std::vector<std::string> held;
  keys.bind_list("Held", held, names,
                 "Displacement components of " + text_of(side.name) +
                   " that are zero, whatever Kind says of the others; empty: none, or "
                   "all with Kind = held [-]");
  keys.only_with("Kind", {"free", "pressure", "springs", "absorbing"}, {"Held"});
  for (unsigned int c = 0; c < 3; ++c)
    side.held[c] = std::count(held.begin(), held.end(), names[c]) > 0;
  keys.require(dim == 3 || !side.held[2], "Held", "u_z is held, but Dimension is 2");
  if (kind == "held")
    std::fill_n(side.held.begin(), dim, true);
}
} // namespace

SideSupport
bind_side(Keys &keys, const std::string &name, const unsigned int dim, std::string kind)
{
  const std::string outer = keys.path("");
  const auto section      = keys.section(name);
  SideSupport side;
  side.name             = name;
  side.section          = outer + name;
  double pressure       = 0.;
  const std::string the = text_of(name);
  keys.bind(
    "Kind", kind, {"free", "pressure", "platen", "held", "springs", "absorbing"},
    "What " + the +
      " stands on: nothing; a pressure; a rigid platen, pushed by the resultant of "
      "the pressure (one common displacement along the normal, none across it); no "
      "motion (u = 0); springs and dashpots, with a pressure; or dashpots that "
      "absorb waves, with a pressure" +
      (name == "Left" ? ". On a mesh sections have the names of its physical groups"
                      : ""));
  bind_held(keys, side, kind, dim);
  keys.bind("Pressure", pressure, Range::any(),
            "Pressure on " + the + ", positive when it presses into the body [Pa]");
  side.pressure = bind_history(keys, pressure, "pressure", "Pa");
  bind_platen_mass(keys, side, the);
  bind_suspension(keys, side.suspension, the, dim);
  side.suspension.absorbing = kind == "absorbing";
  side.is_platen            = kind == "platen";
  keys.only_with("Kind", {"springs"}, {"Mass"});
  keys.only_with("Kind", {"springs", "platen"},
                 {"Spring stiffness", "Dashpot", "Motion"});
  keys.only_with("Kind", {"pressure", "platen", "springs", "absorbing"},
                 {"Pressure", "Ramp", "Ramp time", "Expression"});
  keys.only_with("Kind", {"pressure", "springs", "absorbing"}, {"Traction"});
  keys.require(
    kind != "pressure" || side.is_loaded(), "Pressure",
    "it is 0, but Kind is pressure; give it or a Traction in Pa, or set Kind = "
    "free, as for Analysis = modal, which knows no loads");
  keys.require(kind != "springs" || side.suspension.is_suspended(), "Kind",
               "it is springs, but Spring stiffness, Dashpot and Mass are 0; give one of "
               "them, or set Kind = free");
  for (unsigned int c = 0; c < dim; ++c)
    keys.require(kind == "held" || !side.held[c] ||
                   !(side.suspension.stiffness[c] > 0. ||
                     side.suspension.dashpot[c] > 0. || side.suspension.traction.acts(c)),
                 "Held",
                 std::string("u_") + "xyz"[c] +
                   " is held, so that Spring stiffness, Dashpot and Traction along " +
                   "xyz"[c] + " have no effect; leave one of the two out");
  const std::size_t normal = name == "Left" || name == "Right" ? 0
                             : name == "Bottom"                ? dim - 1
                                                               : 1;
  keys.require((!is_side_of_grid(name) && name != "Bottom") || !side.held[normal] ||
                 pressure == 0.,
               "Pressure",
               std::string("it has no effect, as u_") + "xyz"[normal] +
                 " is held; leave one of the two out");
  for (unsigned int c = 0; c < dim; ++c)
    keys.require(!side.suspension.motion[c].is_expression() || side.suspension.resists(c),
                 "Motion",
                 std::string("along ") + "xyz"[c] +
                   " it has no effect, as there is neither Spring stiffness nor Dashpot; "
                   "give one of them, or leave the expression empty");
  return side;
}
} // namespace mesoslip
