#include "parameters/keys.h"
#include "sliding/contact_parameters.h"
#include "sliding/supports/load_keys.h"
#include "sliding/supports/side_keys.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

namespace mesoslip
{
void ContactParameters::bind_top(Keys &keys)
{
  const auto section = keys.section("Supports/Top");
  std::string kind   = "platen";
  double pressure = 5e6, hold_from = automatic;
  keys.bind("Kind", kind, {"free", "pressure", "platen", "held", "springs", "absorbing"},
            "What the top stands on: nothing; a pressure on each node; a rigid platen "
            "(u_x = 0, one common u_y) pushed by the resultant of the pressure; no "
            "motion (u = 0); springs and dashpots of each node, with a pressure; or "
            "dashpots that absorb waves, as if the body went on, with a pressure");
  keys.bind("Pressure", pressure, Range::any(),
            "Pressure on the top, positive when it presses the body on the flat [Pa]");
  top.pressure = bind_history(keys, pressure, "pressure", "Pa");
  std::vector<std::string> held;
  keys.bind_list("Held", held, {"u_x", "u_y"},
                 "Displacement components along the flat, u_x and, in 3D, u_y, that are "
                 "zero on the top, whatever Kind says of the others; empty: none [-]");
  top.name = "Top";
  top.held = {};
  for (const std::string &component : held)
    top.held[component == "u_x" ? 0 : 1] = true;
  keys.require(mesh.mesh.dim == 3 || !top.held[1], "Held",
               "u_y is along the normal of the flat; set Kind = held, or name u_x only");
  bind_platen_mass(keys, top, "the top");
  bind_suspension(keys, top.suspension, "the top", mesh.mesh.dim);
  keys.bind_or_auto("Hold from", hold_from, Range::non_negative(),
                    "Time from which on the top stays where it is; auto: never [s]");
  if (!std::isnan(hold_from))
    top.hold_from = hold_from;
  keys.only_with("Kind", {"pressure", "springs", "absorbing"}, {"Held"});
  keys.only_with("Kind", {"springs"}, {"Mass"});
  keys.only_with("Kind", {"springs", "platen"},
                 {"Spring stiffness", "Dashpot", "Motion"});
  keys.only_with("Kind", {"pressure", "platen", "springs", "absorbing"},
                 {"Ramp", "Ramp time", "Expression"});
  keys.only_with("Kind", {"pressure", "platen"}, {"Hold from"});
  keys.only_with("Kind", {"pressure", "springs", "absorbing"}, {"Traction"});
  for (unsigned int c = 0; c + 1 < mesh.mesh.dim; ++c)
    keys.require(!top.held[c] ||
                   !(top.suspension.stiffness[c] > 0. || top.suspension.dashpot[c] > 0. ||
                     top.suspension.traction.acts(c)),
                 "Held",
                 std::string("u_") + "xy"[c] +
                   " is held, so that Spring stiffness, Dashpot and Traction along " +
                   "xy"[c] + " have no effect; leave one of the two out");
  // Complex modes take the pressure in steady sliding from it.
  if (analysis == ContactAnalysis::transient)
    keys.only_with("Kind", {"pressure", "platen", "springs", "absorbing"}, {"Pressure"});
  set_top(keys, kind);
}

void ContactParameters::set_top(const Keys &keys, const std::string &kind)
{
  for (unsigned int c = 0; c + 1 < mesh.mesh.dim; ++c)
    keys.require(
      analysis == ContactAnalysis::transient || kind != "absorbing" ||
        !top.suspension.traction.acts(c),
      "Traction",
      "a top that absorbs is held along the flat in the static state, so that "
      "a traction along it has no effect; leave it out, or set Kind = springs");
  Suspension &suspension = top.suspension;
  top.is_platen          = kind == "platen";
  if (kind == "held")
    top.hold();
  suspension.absorbing = kind == "absorbing";
  if (kind == "free")
    top.pressure = LoadHistory();
  keys.require(kind != "springs" || suspension.is_suspended(), "Kind",
               "it is springs, but Spring stiffness, Dashpot and Mass are 0; give one of "
               "them, or set Kind = pressure");
  keys.require(step.alpha_of_phases.empty() || !std::isfinite(top.hold_from), "Hold from",
               "a top that is stopped is not known with a Body/Rayleigh alpha by phase; "
               "give one value for all phases, or set Kind = held");
  keys.require(!suspension.is_there() || !std::isfinite(top.hold_from), "Hold from",
               "the top is held from then on, but there are springs, dashpots or a "
               "traction; leave one of the two out");
  for (unsigned int c = 0; c < mesh.mesh.dim; ++c)
    keys.require(!suspension.motion[c].is_expression() || suspension.stiffness[c] > 0. ||
                   suspension.dashpot[c] > 0.,
                 "Motion",
                 std::string("along ") + "xyz"[c] +
                   " it has no effect, as there is neither Spring stiffness nor Dashpot; "
                   "give one of them, or leave the expression empty");
  for (unsigned int c = 0; c + 1 < mesh.mesh.dim; ++c)
    keys.require(kind != "platen" || suspension.stiffness[c] > 0. ||
                   suspension.dashpot[c] == 0.,
                 "Dashpot",
                 std::string("along ") + "xy"[c] +
                   " the platen moves on springs only; give a Spring stiffness there");
}

/** Binds the sections of sides; on a mesh, of the groups named in the .prm. */
void ContactParameters::bind_sides(Keys &keys)
{
  const auto section             = keys.section("Supports");
  std::vector<std::string> names = sides_of_grid;
  for (const std::string &name : keys.typed_sections())
    if (name != "Top" && !is_side_of_grid(name))
      names.push_back(name);
  supports.clear();
  for (const std::string &name : names)
    {
      const SideSupport side = bind_side(keys, name, mesh.mesh.dim);
      keys.require(mesh.is_given() || is_side_of_grid(name), name,
                   "the body is a grid, whose sides are Left, Right, Front, Back and "
                   "Top; name one of them, or set Mesh/File");
      keys.require(!mesh.is_given() || name != mesh.top_boundary, name,
                   "it is Mesh/Top boundary, whose section is Supports/Top; move its "
                   "keys there");
      keys.require(
        !std::isfinite(top.hold_from) || !(side.suspension.mass > 0.), name + "/Mass",
        "the top is held from Supports/Top/Hold from on, and a corner has this "
        "mass, too; leave one of the two out");
      if (!side.holds() && !side.is_loaded())
        continue;
      for (const auto &groups : mesh.periodic)
        keys.require(std::count(groups.begin(), groups.end(), name) == 0, name + "/Kind",
                     "the group is one of Mesh/Periodic in x or y, which are free; leave "
                     "its section out");
      supports.push_back(side);
    }
  keys.only_if(mesh.mesh.dim == 3 || mesh.is_given(), {"Front/", "Back/"},
               "the body is plane", "set Dimension = 3");
  hold_sides();
  if (!mesh.is_given())
    check_platen(keys);
}

std::vector<SideSupport> ContactParameters::loaded_sides() const
{
  std::vector<SideSupport> loaded;
  for (const bool is_platen : {true, false})
    std::copy_if(supports.begin(), supports.end(), std::back_inserter(loaded),
                 [&](const SideSupport &side) {
                   return side.is_loaded() && side.is_platen == is_platen;
                 });
  return loaded;
}

std::vector<const SideSupport *> ContactParameters::suspended() const
{
  std::vector<const SideSupport *> all = {&top};
  for (const SideSupport &side : supports)
    if (side.is_loaded())
      all.push_back(&side);
  return all;
}

bool ContactParameters::supports_keep_energy() const
{
  const std::vector<const SideSupport *> all = suspended();
  return std::any_of(all.begin(), all.end(),
                     [](const SideSupport *side) { return side->keeps_energy(); });
}

bool ContactParameters::is_moved_normally() const
{
  const std::vector<const SideSupport *> all = suspended();
  return std::any_of(all.begin(), all.end(), [&](const SideSupport *side) {
    return side->suspension.motion[mesh.mesh.dim - 1].is_expression() ||
           side->suspension.traction.acts(mesh.mesh.dim - 1);
  });
}

bool ContactParameters::sides_carry_normally() const
{
  return std::any_of(supports.begin(), supports.end(), [&](const SideSupport &side) {
    return side.is_loaded() || side.held[mesh.mesh.dim - 1];
  });
}

bool ContactParameters::presses_on_flat() const
{
  const auto acts = [](const SideSupport &side) {
    return side.suspension.is_there() || side.pressure.is_expression();
  };
  return counter || !profile.expression.empty() || !profile.file.empty() || acts(top) ||
         step.acceleration[mesh.mesh.dim - 1] < 0. || top.pressure.amplitude() > 0. ||
         std::any_of(supports.begin(), supports.end(), [&](const SideSupport &side) {
           return acts(side) || side.pressure.amplitude() != 0.;
         });
}

bool ContactParameters::friction_is_at_top() const
{
  for (const SideSupport &side : supports)
    for (unsigned int c = 0; c < mesh.mesh.dim; ++c)
      if (side.is_loaded() ||
          (side.held[c] && (c + 1 == mesh.mesh.dim || top.direction[c] != 0.)))
        return false;
  return top.takes_friction();
}

/** Stores the constraints of the sides in the forms for plane grids and for meshes. */
void ContactParameters::hold_sides()
{
  for (const SideSupport &side : supports)
    for (unsigned int c = 0; c < 3; ++c)
      if (side.held[c])
        {
          mesh.held[c].push_back(side.name);
          if (c < 2 && side.name == "Left")
            sides.left_held[c] = true;
          if (c < 2 && side.name == "Right")
            sides.right_held[c] = true;
        }
}

void ContactParameters::bind_periodicity(Keys &keys)
{
  const auto section = keys.section("Sides");
  bool in_y          = false;
  keys.bind("Periodic", periodic,
            "Periodic in x: the nodes of the left and the right side are the same");
  keys.bind("Periodic in y", in_y, "The same for the front and the back side, in 3D");
  keys.only_if(mesh.mesh.dim == 3, {"Periodic in y"}, "the body is plane",
               "set Dimension = 3");
  for (const std::string &side : sides_of_grid)
    keys.renamed(side, "Supports/" + side + "/Held");
  if (mesh.is_given())
    return;
  const std::array<bool, 2> is_periodic = {{periodic, in_y}};
  for (std::size_t axis = 0; axis < 2; ++axis)
    {
      const std::string &lower = sides_of_grid[2 * axis],
                        &upper = sides_of_grid[2 * axis + 1];
      if (is_periodic[axis])
        mesh.periodic[axis] = {lower, upper};
      for (const SideSupport &side : supports)
        keys.require(!is_periodic[axis] || (side.name != lower && side.name != upper),
                     axis == 0 ? "Periodic" : "Periodic in y",
                     "it is true, so " + lower + " and " + upper +
                       " have to be free, but Supports/" + side.name + " is not");
    }
}

/** Checks that no side constrains corners that the platen of the top moves. */
void ContactParameters::check_platen(const Keys &keys) const
{
  const unsigned int normal = mesh.mesh.dim - 1;
  for (const SideSupport &side : supports)
    for (unsigned int c = 0; c < mesh.mesh.dim; ++c)
      keys.require(
        !top.is_platen || !side.held[c] || (c != normal && top.holds(c)),
        side.name + "/Held",
        std::string("u_") + "xyz"[c] +
          " is held, but the platen of Supports/Top/Kind moves the corner; hold " +
          (c == normal ? "u_x only" : "nothing there") + ", or set Supports/Top/Kind = " +
          (top.suspension.is_there() ? "springs" : "pressure or held"));
}
} // namespace mesoslip
