#include "sliding/supports/support_text.h"

#include "base/text.h"

#include <algorithm>
#include <array>

namespace mesoslip
{
namespace
{
/** "springs of 1e+12, 0 Pa/m", or empty if all are 0. */
std::string components_text(const char *what,
                            const std::array<double, 3> &values,
                            const unsigned int dim,
                            const char *unit)
{
  std::string text;
  if (values == std::array<double, 3>{})
    return text;
  for (unsigned int c = 0; c < dim; ++c)
    text += (c > 0 ? ", " : std::string(what) + " of ") + to_text(values[c]);
  return text + " " + unit;
}

/** "a far end at t, 0 m". */
std::string motion_text(const Suspension &suspension, const unsigned int dim)
{
  std::string text;
  bool moves = false;
  for (unsigned int c = 0; c < dim; ++c)
    {
      const LoadHistory &motion = suspension.motion[c];
      moves                     = moves || motion.is_expression();
      text += (c > 0 ? ", " : "") + (motion.is_expression() ? motion.shape() : "0");
    }
  return moves ? "a far end at " + text + " m" : "";
}

/** "a traction of x, 0 Pa". */
std::string traction_text(const Traction &traction, const unsigned int dim)
{
  std::string text;
  for (unsigned int c = 0; c < dim; ++c)
    text += (c > 0 ? ", " : "") + (traction.acts(c) ? traction.text(c) : "0");
  return traction.is_there() ? "a traction of " + text + " Pa" : "";
}

std::string pressure_text(const LoadHistory &pressure)
{
  if (pressure.is_expression())
    return "a pressure of " + pressure.shape() + " Pa";
  if (pressure.amplitude() == 0.)
    return "";
  return "a pressure of " + to_text(pressure.amplitude()) + " Pa" +
         (pressure.duration() > 0. ? " after a " + pressure.shape() + " ramp of " +
                                       to_text(pressure.duration()) + " s"
                                   : "");
}
} // namespace

std::string kind_of(const SideSupport &side, const unsigned int dim)
{
  if (side.is_platen)
    return "platen";
  if (side.suspension.absorbing)
    return "absorbing";
  if (side.suspension.is_suspended())
    return "springs";
  if (std::all_of(side.held.begin(), side.held.begin() + dim,
                  [](const bool held) { return held; }))
    return "held";
  return side.is_loaded() ? "pressure" : "free";
}

std::string support_text(const SideSupport &side, const unsigned int dim)
{
  const Suspension &on = side.suspension;
  std::string text;
  const bool of_top         = side.name == "Top";
  const std::string of_mass = side.platen_mass > 0. ? " of " + to_text(side.platen_mass) +
                                                        (dim == 2 ? " kg/m" : " kg")
                                                    : std::string();
  for (const std::string &part :
       {side.is_platen && !of_top ? "a rigid platen" + of_mass : std::string(),
        components_text("springs", on.stiffness, dim, "Pa/m"),
        components_text("dashpots", on.dashpot, dim, "Pa s/m"),
        std::string(on.absorbing ? "dashpots of the impedances behind it" : ""),
        on.mass > 0. ? "a mass of " + to_text(on.mass) + " kg/m^2" : std::string(),
        motion_text(on, dim), traction_text(on.traction, dim),
        of_top ? "" : pressure_text(side.pressure)})
    if (!part.empty())
      text += (text.empty() ? side.name + ": " : "; ") + part;
  return text;
}

std::string support_texts(const ContactParameters &parameters)
{
  std::string all;
  for (const SideSupport *side : parameters.suspended())
    if (const std::string text = support_text(*side, parameters.mesh.mesh.dim);
        !text.empty())
      all += (all.empty() ? "" : " | ") + text;
  return all;
}
} // namespace mesoslip
