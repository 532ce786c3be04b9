#include "sliding/supports/support_keys.h"

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
/** A value of Kind, what it stands for, and the keys that have an effect with it. */
struct SupportKind
{
  std::string name, meaning;
  bool is_loaded;                ///< whether it has a pressure
  std::vector<std::string> keys; ///< besides those of the pressure
};

const std::vector<SupportKind> support_kinds = {
  {"free", "nothing", false, {"Held"}},
  {"pressure", "on each node", true, {"Held", "Traction"}},
  {"platen",
   "rigid, pushed by the resultant of the pressure; one common displacement along the "
   "normal, across it only on springs",
   true,
   {"Platen mass", "Spring stiffness", "Dashpot", "Motion"}},
  {"held", "u = 0", false, {}},
  {"springs",
   "and dashpots of each node, with a pressure",
   true,
   {"Held", "Traction", "Mass", "Spring stiffness", "Dashpot", "Motion"}},
  {"absorbing",
   "waves leave through dashpots, as if the body went on, with a pressure",
   true,
   {"Held", "Traction"}}};

/** Names of the kinds that @p is_chosen selects. */
template <typename Function>
std::vector<std::string> kinds_with(const Function &is_chosen)
{
  std::vector<std::string> names;
  for (const SupportKind &kind : support_kinds)
    if (is_chosen(kind))
      names.push_back(kind.name);
  return names;
}

/** Refuses keys that have no effect with the kind. */
void check_effects(const Keys &keys, const SupportDefaults &defaults)
{
  const auto is_loaded = [](const SupportKind &kind) { return kind.is_loaded; };
  keys.only_with("Kind", kinds_with(is_loaded), {"Ramp", "Ramp time", "Expression"});
  if (defaults.needs_pressure)
    keys.only_with("Kind", kinds_with(is_loaded), {"Pressure"});
  for (const char *const key : {"Held", "Traction", "Platen mass", "Mass",
                                "Spring stiffness", "Dashpot", "Motion"})
    keys.only_with("Kind", kinds_with([&](const SupportKind &kind) {
                     return std::count(kind.keys.begin(), kind.keys.end(), key) > 0;
                   }),
                   {key});
}

/** "the top", "side Front (lower y)", "group 'wall'". */
std::string text_of(const std::string &name)
{
  if (name == "Top" || name == "Bottom")
    return name == "Top" ? "the top" : "the bottom";
  if (!is_side_of_grid(name))
    return "group '" + name + "'";
  const bool lower = name == "Left" || name == "Front";
  return "side " + name + (lower ? " (lower " : " (upper ") +
         (name == "Left" || name == "Right" ? "x)" : "y)");
}

/** Axis of the normal of a side of a grid, or @p dim for the top and mesh groups. */
unsigned int normal_of(const std::string &name, const unsigned int dim)
{
  if (name == "Bottom")
    return dim - 1;
  return !is_side_of_grid(name) ? dim : name == "Left" || name == "Right" ? 0 : 1;
}

/** Binds the constrained components; Kind = held constrains all. */
void bind_held(Keys &keys,
               SideSupport &side,
               const std::string &kind,
               const unsigned int dim,
               const bool is_top)
{
  std::vector<std::string> names = {"u_x", "u_y", "u_z"}, held;
  names.resize(is_top ? 2 : 3);
  keys.bind_list("Held", held, names,
                 std::string("Displacement components ") +
                   (is_top ? "along the flat, u_x and, in 3D, u_y, " : "") + "of " +
                   text_of(side.name) +
                   " that are zero, whatever Kind says of the others; empty: none, or "
                   "all with Kind = held [-]");
  for (std::size_t c = 0; c < names.size(); ++c)
    side.held[c] = std::count(held.begin(), held.end(), names[c]) > 0;
  keys.require(dim == 3 || !side.held[2], "Held", "u_z is held, but Dimension is 2");
  keys.require(dim == 3 || !is_top || !side.held[1], "Held",
               "u_y is along the normal of the flat; set Kind = held, or name u_x only");
  if (kind == "held")
    std::fill_n(side.held.begin(), is_top ? 3 : dim, true); // see TopSetup::is_held()
}

/** Refuses what a constrained component or missing springs make useless. */
void check_support(const Keys &keys,
                   const SideSupport &side,
                   const std::string &kind,
                   const unsigned int dim,
                   const bool is_top)
{
  const Suspension &on       = side.suspension;
  const std::string unloaded = is_top ? "pressure" : "free";
  keys.require(kind != "pressure" || is_top || side.is_loaded(), "Pressure",
               "it is 0, but Kind is pressure; give it or a Traction in Pa, or set Kind "
               "= free, as for Analysis = modal, which knows no loads");
  keys.require(kind != "springs" || on.is_suspended(), "Kind",
               "it is springs, but Spring stiffness, Dashpot and Mass are 0; give one of "
               "them, or set Kind = " +
                 unloaded);
  for (unsigned int c = 0; c < dim; ++c)
    {
      const std::string axis(1, "xyz"[c]);
      keys.require(kind == "held" || !side.held[c] ||
                     !(on.stiffness[c] > 0. || on.dashpot[c] > 0. || on.traction.acts(c)),
                   "Held",
                   "u_" + axis +
                     " is held, so that Spring stiffness, Dashpot and Traction along " +
                     axis + " have no effect; leave one of the two out");
      keys.require(!on.motion[c].is_expression() || on.resists(c), "Motion",
                   "along " + axis +
                     " it has no effect, as there is neither Spring stiffness nor "
                     "Dashpot; give one of them, or leave the expression empty");
    }
  const unsigned int normal = normal_of(side.name, dim);
  keys.require(
    normal == dim || !side.held[normal] || side.pressure.amplitude() == 0., "Pressure",
    std::string("it has no effect, as u_") + "xyz"[normal == dim ? 0 : normal] +
      " is held; leave one of the two out");
}
} // namespace

SideSupport bind_support(Keys &keys,
                         const std::string &name,
                         const unsigned int dim,
                         const SupportDefaults &defaults)
{
  const std::string outer = keys.path(""), the = text_of(name);
  const auto section = keys.section(name);
  SideSupport side;
  side.name         = name;
  side.section      = outer + name;
  std::string kinds = "What " + the + " stands on", kind = defaults.kind;
  for (const SupportKind &one : support_kinds)
    kinds += (&one == &support_kinds.front() ? ": " : ", ") + one.name + " (" +
             one.meaning + ")";
  if (name == "Left")
    kinds += ". On a mesh sections have the names of its physical groups";
  keys.bind("Kind", kind, kinds_with([](const SupportKind &) { return true; }), kinds);
  bind_held(keys, side, kind, dim, defaults.is_top);
  double pressure = defaults.pressure;
  keys.bind("Pressure", pressure, Range::any(),
            "Pressure on " + the + ", positive when it presses into the body [Pa]");
  side.pressure = bind_history(keys, pressure, "pressure", "Pa");
  bind_platen_mass(keys, side, the);
  bind_suspension(keys, side.suspension, the, dim);
  side.suspension.absorbing = kind == "absorbing";
  side.is_platen            = kind == "platen";
  if (kind == "free")
    side.pressure = LoadHistory();
  check_effects(keys, defaults);
  check_support(keys, side, kind, dim, defaults.is_top);
  return side;
}
} // namespace mesoslip
