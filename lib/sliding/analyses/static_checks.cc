#include "base/errors.h"
#include "sliding/analyses/static_load.h"

#include <algorithm>
#include <vector>

namespace mesoslip
{
TopSetup top_at_rest(const ContactParameters &parameters)
{
  TopSetup top = parameters.top;
  if (top.suspension.absorbing)
    top.held[0] = top.held[1] = true;
  return top;
}

namespace
{
/** Whether a support holds the body along axis @p c. */
bool is_held_along(const ContactParameters &p, const BodySize &body, const unsigned int c)
{
  if (top_at_rest(p).holds(c) || !p.mesh.held[c].empty())
    return true;
  for (const SideSupport *side : p.suspended())
    if (side->suspension.stiffness[c] > 0.)
      return true;
  const std::vector<SideSupport> sides = p.loaded_sides();
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (sides[k].is_platen && !body.side_moves[k][c])
      return true;
  return false;
}

/** Key of a load that moves a body without support along axis @p c; empty: there
 * is none. */
std::string
mover_along(const ContactParameters &p, const BodySize &body, const unsigned int c)
{
  const std::vector<SideSupport> sides = p.loaded_sides();
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (body.side_moves[k][c] || sides[k].suspension.traction.acts(c) ||
        body.side_push[k][c] * sides[k].pressure.amplitude() != 0.)
      return sides[k].key(sides[k].is_platen ? "Kind = platen" : "Pressure or Traction");
  if (p.top.suspension.traction.acts(c))
    return p.top.key("Traction");
  return p.step.acceleration[c] != 0. ? "Body/Acceleration" : "";
}

/** Checks that a support holds the body along the flat. */
void check_lateral_support(const ContactParameters &p,
                           const BodySize &body,
                           const bool rubs)
{
  const double speed                 = p.contact.flat_velocity.amplitude();
  const std::vector<double> &of_flat = p.static_load.of_flat;
  for (unsigned int c = 0; c + 1 < p.mesh.mesh.dim; ++c)
    {
      if (is_held_along(p, body, c))
        continue;
      const std::string side = std::string(p.mesh.is_given() ? "a group" : "a side") +
                               " in u_" + "xy"[c] + " (Supports)";
      const std::string remedy =
        p.top.suspension.is_there()
          ? std::string("give a Supports/Top/Spring stiffness along ") + "xy"[c] +
              ", hold " + side
          : "set Supports/Top/Held, hold " + side + ", set Supports/Top/Kind = platen";
      if (rubs && speed * p.contact.flat_direction[c] != 0.)
        throw UserError(
          "Nothing holds the body against the friction of the sliding flat: " + remedy +
          ", or set Friction/Coefficient = 0 or Flat/Velocity = 0");
      if (c < of_flat.size() && of_flat[c] != 0.)
        throw UserError(
          "Static contact/Flat displacement: nothing holds the body against the flat; " +
          remedy);
      if (const std::string mover = mover_along(p, body, c); !rubs && !mover.empty())
        throw UserError(mover + ": nothing holds the body along " + "xy"[c] + "; " +
                        remedy + ", or give a Friction/Coefficient");
    }
}

/** Checks that friction does not tip the body on a flat contact: the resultant of the
 * pressure acts in the middle, the reaction at most half the width from there. Their
 * moment has to balance the moment of the friction between flat and top. */
void check_tipping(const ContactParameters &p,
                   const BodyFacts<2> &body,
                   const double least_friction)
{
  const double height = body.scales.height, half = 0.5 * body.scales.area;
  const bool held = !p.mesh.held[0].empty() || !p.mesh.held[1].empty() ||
                    p.suspended().size() > 1,
             may_tip = !p.top.is_platen && top_at_rest(p).held[0] && !p.periodic &&
                       !held && !p.step.is_heavy() &&
                       p.contact.flat_velocity.amplitude() != 0.;
  if (may_tip && least_friction * height > half)
    throw UserError(
      "Friction/Coefficient: the friction of the sliding flat tips the body, as a "
      "coefficient of " +
      to_text(least_friction) + " times the height of " + to_text(height) +
      " m is more than half the width, " + to_text(half) +
      " m: there is no equilibrium; reduce it, or set Supports/Top/Kind = platen");
}
} // namespace

template <int dim>
void check_static_load(const ContactParameters &p, const BodyFacts<dim> &body)
{
  const auto [least, most] =
    std::minmax_element(body.size.friction.begin(), body.size.friction.end());
  if (p.top.is_held())
    throw UserError(
      "Supports/Top/Kind is held, so nothing presses the body on the flat; use "
      "platen or pressure for a static contact analysis");
  if (!(p.top.pressure.amplitude() > 0.) &&
      !(p.top.pressure.amplitude() == 0. &&
        (p.top.is_platen ? p.top.suspension.motion[dim - 1].is_expression()
                         : p.is_moved_normally())))
    throw UserError(
      "Supports/Top/Pressure is " + to_text(p.top.pressure.amplitude()) +
      " Pa; a static contact analysis needs a positive one, with Supports/Top/Kind "
      "= platen, pressure, springs or absorbing");
  if (p.contact.gap != 0.)
    throw UserError("Flat/Gap is " + to_text(p.contact.gap) +
                    " m; a static contact analysis starts from a body that touches the "
                    "flat, set it to 0");
  check_lateral_support(p, body.size, *most > 0.);
  if constexpr (dim == 2)
    if (body.contact_height.empty() && !p.contact.profile)
      check_tipping(p, body, *least);
}

template void check_static_load(const ContactParameters &, const BodyFacts<2> &);
template void check_static_load(const ContactParameters &, const BodyFacts<3> &);
} // namespace mesoslip
