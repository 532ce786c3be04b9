#include "base/errors.h"
#include "base/text.h"
#include "parameters/keys.h"
#include "sliding/contact_parameters.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** The key of an amplitude is bound already. */
LoadHistory bind_history(Keys &keys,
                         const double amplitude,
                         const std::string &what,
                         const std::string &unit)
{
  Ramp ramp   = Ramp::step;
  double time = 0.;
  std::string expression;
  keys.bind("Ramp", ramp, {"step", "linear", "smooth"},
            "How the " + what +
              " grows from zero: at once, as t / T or as (1 - cos(pi t / T)) / 2 in the "
              "Ramp time T");
  keys.bind("Ramp time", time, Range::non_negative(),
            "Time T in which the " + what + " grows to its full value [s]");
  keys.bind("Expression", expression,
            "The " + what +
              " as an expression in the time t (s), instead of a ramp, e.g. "
              "2*cos(2*pi*1000*t) [" +
              unit + "]");
  keys.only_if(expression.empty(), {"Ramp", "Ramp time"},
               keys.path("Expression") + " gives the load at all times",
               "leave " + keys.path("Expression") + " empty");
  keys.only_with("Ramp", {"linear", "smooth"}, {"Ramp time"});
  keys.require(ramp == Ramp::step || time > 0., "Ramp time",
               "it is 0, so that the " + what +
                 " acts at once; give it in s, or set Ramp = step");
  if (expression.empty())
    return {amplitude, ramp, time};
  try
    {
      LoadHistory history(amplitude, expression);
      keys.require(std::isfinite(history(0.)), "Expression",
                   "at t = 0 it is " + to_text(history(0.)) +
                     "; write an expression that is finite at all times");
      return history;
    }
  catch (const std::invalid_argument &e)
    {
      throw UserError(keys.path("Expression") + ": " + e.what() +
                      "; write for example 2*cos(2*pi*1000*t)");
    }
}

/** Puts the direction of the flat into @p p; its speed along it (m/s). */
double bind_flat_direction(Keys &keys, ContactParameters &p)
{
  std::vector<double> velocity = {2.};
  keys.bind_list("Velocity", velocity, Range::any(),
                 "Velocity of the rigid flat along x and, in 3D, y (0 where it is left "
                 "out). With two components a ramp or an expression is along their "
                 "direction [m/s]",
                 1, 2);
  keys.require(velocity.size() < 2 || p.mesh.mesh.dim == 3, "Velocity",
               "it has two components, but Dimension is 2; give the one along x");
  if (velocity.size() < 2 || velocity[1] == 0.)
    return velocity[0];
  const double speed = std::hypot(velocity[0], velocity[1]);
  keys.require(std::isfinite(speed), "Velocity", "its size is infinite; give it in m/s");
  p.contact.flat_direction = {{velocity[0] / speed, velocity[1] / speed}};
  p.top.direction          = p.contact.flat_direction;
  return speed;
}

/** An expression of t for each component of the far end, separated by semicolons. */
void bind_motion(Keys &keys, Suspension &suspension, const unsigned int dim)
{
  std::string motion;
  keys.bind(
    "Motion", motion,
    "Displacement of the far end of springs and dashpots along x, y and, in 3D, z "
    "as expressions in the time t (s), separated by semicolons, e.g. 1e-3*t; 0. "
    "Components that are left out do not move; static contact takes the values at t = 0 "
    "[m]");
  std::istringstream text(motion);
  std::string expression;
  for (unsigned int c = 0; std::getline(text, expression, ';'); ++c)
    {
      keys.require(c < dim, "Motion",
                   "it has more than " + std::to_string(dim) +
                     " expressions; give one for each component");
      if (expression.find_first_not_of(" \t") == std::string::npos)
        continue;
      try
        {
          suspension.motion[c] = LoadHistory(1., expression);
        }
      catch (const std::invalid_argument &e)
        {
          throw UserError(keys.path("Motion") + ": " + e.what() +
                          "; write for example 1e-3*t; 0");
        }
      const double at_start = suspension.motion[c](0.);
      keys.require(std::isfinite(at_start), "Motion",
                   "at t = 0 it is " + to_text(at_start) +
                     "; write expressions that are finite at all times");
    }
}

/** Springs, dashpots and mass of the top. */
void bind_suspension(Keys &keys, Suspension &suspension, const unsigned int dim)
{
  const auto bind = [&](const std::string &key, std::array<double, 3> &to,
                        const std::string &meaning) {
    std::vector<double> values = {0.};
    keys.bind_list(key, values, Range::non_negative(), meaning, 1, 3);
    keys.require(
      values.size() <= dim, key,
      "it has " + std::to_string(values.size()) + " components, but " +
        (dim == 2 ? "Dimension is 2; give those along x and y" : "there are three"));
    std::copy(values.begin(), values.end(), to.begin());
  };
  bind("Spring stiffness", suspension.stiffness,
       "Stiffness for the area along x, y and, in 3D, z of springs from the top to a far "
       "end; 0 where it is left out. A platen moves along the flat only on springs "
       "[Pa/m]");
  bind("Dashpot", suspension.dashpot, "The same of dashpots beside the springs [Pa s/m]");
  keys.bind("Mass", suspension.mass, Range::non_negative(),
            "Mass for the area that moves with each node of the top; "
            "Body/Acceleration acts on it [kg/m^2]");
  bind_motion(keys, suspension, dim);
}

/** The components that are held on a side of the body, x to z. */
std::array<bool, 3> bind_side(Keys &keys, const std::string &key, const std::string &side)
{
  unsigned int value = 0;
  keys.bind(key, value,
            {"free", "u_x", "u_y", "both", "u_z", "u_x u_z", "u_y u_z", "all"},
            "Displacement components that are zero on the " + side +
              " side; both: u_x and u_y; those with u_z, and all three, in 3D");
  return {{(value & 1) != 0, (value & 2) != 0, (value & 4) != 0}};
}

/** The sides of a grid are groups as those of a mesh. */
void use_sides_of_grid(MeshBodyParameters &mesh,
                       const std::array<std::array<bool, 3>, 4> &held,
                       const std::array<bool, 2> &periodic)
{
  const std::string names[] = {"Left", "Right", "Front", "Back"};
  for (unsigned int side = 0; side < 4; ++side)
    for (unsigned int c = 0; c < 3; ++c)
      if (held[side][c])
        mesh.held[c].push_back(names[side]);
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (periodic[axis])
      mesh.periodic[axis] = {names[2 * axis], names[2 * axis + 1]};
}

} // namespace

void ContactParameters::bind_loads(Keys &keys)
{
  {
    const auto section    = keys.section("Flat");
    const double speed    = bind_flat_direction(keys, *this);
    contact.flat_velocity = bind_history(keys, speed, "velocity", "m/s");
    keys.bind("Gap", contact.gap, Range::non_negative(),
              "Distance between the body and the flat at the start [m]");
    double stiffness = automatic;
    keys.bind_or_auto("Normal stiffness", stiffness, Range::positive(),
                      "Stiffness for the area of springs between body and flat, as of "
                      "the asperities of rough surfaces; auto: none, the flat is rigid "
                      "[Pa/m]");
    if (!std::isnan(stiffness))
      contact.normal_stiffness = stiffness;
  }
  bind_top(keys);
}

void ContactParameters::bind_top(Keys &keys)
{
  const auto section = keys.section("Top");
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
  keys.bind("Lateral held", top.lateral_held,
            "Keep u_x = 0 on the top also under Kind = pressure, as under a platen");
  keys.bind("Platen mass", top.platen_mass, Range::non_negative(),
            "Mass of the platen, which moves with the top, in 2D per unit thickness; "
            "Body/Acceleration does not act on it [kg/m, in 3D kg]");
  bind_suspension(keys, top.suspension, mesh.mesh.dim);
  keys.bind_or_auto("Hold from", hold_from, Range::non_negative(),
                    "Time from which on the top stays where it is; auto: never [s]");
  if (!std::isnan(hold_from))
    top.hold_from = hold_from;
  keys.only_with("Kind", {"pressure"}, {"Lateral held"});
  keys.only_with("Kind", {"platen"}, {"Platen mass"});
  keys.only_with("Kind", {"springs"}, {"Mass"});
  keys.only_with("Kind", {"springs", "platen"},
                 {"Spring stiffness", "Dashpot", "Motion"});
  keys.only_with("Kind", {"pressure", "platen", "springs", "absorbing"},
                 {"Ramp", "Ramp time", "Expression"});
  keys.only_with("Kind", {"pressure", "platen"}, {"Hold from"});
  // Steady sliding under complex modes takes its pressure from there.
  if (analysis == ContactAnalysis::transient)
    keys.only_with("Kind", {"pressure", "platen", "springs", "absorbing"}, {"Pressure"});
  set_top(keys, kind);
}

void ContactParameters::set_top(const Keys &keys, const std::string &kind)
{
  Suspension &suspension = top.suspension;
  top.kind               = kind == "platen" ? TopSetup::Kind::platen
                           : kind == "held" ? TopSetup::Kind::held
                                            : TopSetup::Kind::pressure;
  suspension.absorbing   = kind == "absorbing";
  if (kind == "free")
    top.pressure = LoadHistory();
  keys.require(kind != "springs" || suspension.is_there(), "Kind",
               "it is springs, but Spring stiffness, Dashpot and Mass are 0; give one of "
               "them, or set Kind = pressure");
  keys.require(!suspension.is_there() || !std::isfinite(top.hold_from), "Hold from",
               "the top is held from then on, but there are springs or dashpots; leave "
               "one of the two out");
  keys.require(kind != "platen" || !suspension.is_there() ||
                 analysis == ContactAnalysis::transient,
               "Kind",
               "it is a platen on springs, which transient runs alone know; set it to "
               "springs, which hold each node by itself");
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

void ContactParameters::bind_sides(Keys &keys)
{
  const auto section                            = keys.section("Sides");
  const std::array<std::array<bool, 3>, 4> held = {
    {bind_side(keys, "Left", "left"), bind_side(keys, "Right", "right"),
     bind_side(keys, "Front", "front (lower y)"),
     bind_side(keys, "Back", "back (upper y)")}};
  std::copy_n(held[0].begin(), 2, sides.left_held.begin());
  std::copy_n(held[1].begin(), 2, sides.right_held.begin());
  bool periodic_in_y = false;
  keys.bind("Periodic", periodic,
            "Periodic in x: the nodes of the left and the right side are the same");
  keys.bind("Periodic in y", periodic_in_y,
            "The same for the front and the back side, in 3D");
  keys.only_if(mesh.mesh.dim == 3, {"Front", "Back", "Periodic in y"},
               "the body is plane", "set Dimension = 3");
  const std::string names[] = {"Left", "Right", "Front", "Back"};
  const unsigned int normal = mesh.mesh.dim - 1;
  for (unsigned int side = 0; side < 4; ++side)
    {
      const auto &h     = held[side];
      const bool is_one = side < 2 ? periodic : periodic_in_y;
      keys.require(mesh.mesh.dim == 3 || !h[2], names[side],
                   "u_z is held, but Dimension is 2");
      keys.require(!is_one || !(h[0] || h[1] || h[2]),
                   side < 2 ? "Periodic" : "Periodic in y",
                   side < 2 ? "it is true, so Left and Right have to be free"
                            : "it is true, so Front and Back have to be free");
      for (unsigned int c = 0; c < mesh.mesh.dim; ++c)
        keys.require(
          top.kind != TopSetup::Kind::platen || !h[c] || (c != normal && top.holds(c)),
          names[side],
          std::string("u_") + "xyz"[c] +
            " is held, but the platen of Top/Kind moves the corner; hold " +
            (c == normal ? "u_x only" : "nothing there") + ", or set Top/Kind = " +
            (top.suspension.is_there() ? "springs" : "pressure or held"));
    }
  if (!mesh.is_given())
    use_sides_of_grid(mesh, held, {{periodic, periodic_in_y}});
}
} // namespace mesoslip
