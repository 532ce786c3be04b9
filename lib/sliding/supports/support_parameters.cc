#include "parameters/keys.h"
#include "sliding/contact_parameters.h"
#include "sliding/supports/load_keys.h"
#include "sliding/supports/support_keys.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

namespace mesoslip
{
void ContactParameters::bind_top(Keys &keys)
{
  const auto outer = keys.section("Supports");
  // Complex modes take the pressure in steady sliding from it, whatever holds the top.
  static_cast<SideSupport &>(top) =
    bind_support(keys, "Top", mesh.mesh.dim,
                 {"platen", 5e6, true, analysis == ContactAnalysis::transient});
  const auto section = keys.section("Top");
  double hold_from   = automatic;
  keys.bind_or_auto("Hold from", hold_from, Range::non_negative(),
                    "Time from which on the top stays where it is; auto: never [s]");
  if (!std::isnan(hold_from))
    top.hold_from = hold_from;
  keys.only_with("Kind", {"pressure", "platen"}, {"Hold from"});
  check_top(keys);
}

void ContactParameters::check_top(const Keys &keys) const
{
  const Suspension &suspension = top.suspension;
  keys.require(step.alpha_of_phases.empty() || !std::isfinite(top.hold_from), "Hold from",
               "a top that is stopped is not known with a Body/Rayleigh alpha by phase; "
               "give one value for all phases, or set Kind = held");
  keys.require(!suspension.is_there() || !std::isfinite(top.hold_from), "Hold from",
               "the top is held from then on, but there are springs, dashpots or a "
               "traction; leave one of the two out");
  for (unsigned int c = 0; c + 1 < mesh.mesh.dim; ++c)
    {
      keys.require(
        analysis == ContactAnalysis::transient || !suspension.absorbing ||
          !suspension.traction.acts(c),
        "Traction",
        "a top that absorbs is held along the flat in the static state, so that "
        "a traction along it has no effect; leave it out, or set Kind = springs");
      keys.require(!top.is_platen || suspension.stiffness[c] > 0. ||
                     suspension.dashpot[c] == 0.,
                   "Dashpot",
                   std::string("along ") + "xy"[c] +
                     " the platen moves on springs only; give a Spring stiffness there");
    }
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
      const SideSupport side = bind_support(keys, name, mesh.mesh.dim);
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
