#include "sliding/supports/side_platen.h"

#include "base/errors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace mesoslip
{
unsigned int
normal_of(const SideSupport &side, const SideNodes &nodes, const unsigned int dim)
{
  constexpr double tolerance       = 1e-6;
  const double area                = nodes.whole_area();
  const std::array<double, 3> push = nodes.whole_push();
  for (unsigned int c = 0; c < dim; ++c)
    {
      const std::vector<double> &place = nodes.position[c];
      const auto [first, last]         = std::minmax_element(place.begin(), place.end());
      const double length              = dim == 2 ? area : std::sqrt(area);
      if (std::fabs(std::fabs(push[c]) - area) <= tolerance * area &&
          *last - *first <= tolerance * length)
        return c;
    }
  throw UserError(side.key("Kind") +
                  " is platen, but its faces are not in one plane across an axis; a "
                  "platen moves plane sides along their normal, set Kind = "
                  "springs or pressure");
}

std::array<bool, 3> moves_of_platen(const SideSupport &side,
                                    const unsigned int normal,
                                    const unsigned int dim)
{
  std::array<bool, 3> moves = {};
  for (unsigned int c = 0; c < dim; ++c)
    {
      moves[c] = c == normal || side.suspension.stiffness[c] > 0.;
      if (!moves[c] && side.suspension.dashpot[c] > 0.)
        throw UserError(
          side.key("Dashpot") + ": along " + "xyz"[c] +
          " the platen moves on springs only; give a Spring stiffness there");
    }
  return moves;
}

void carry_whole_side(SideNodes &nodes,
                      const std::vector<bool> &own,
                      const SideSupport &side)
{
  double whole = 0., carried = 0.;
  for (std::size_t k = 0; k < own.size(); ++k)
    {
      whole += nodes.area[k];
      carried += own[k] ? nodes.area[k] : 0.;
    }
  if (!(carried > 0.))
    throw UserError(
      side.key("Kind") +
      " is platen, but all nodes of the side belong to the contact, the top "
      "or other supports; take more cells, or leave it out");
  const auto give = [&](std::vector<double> &values) {
    for (std::size_t k = 0; k < values.size(); ++k)
      values[k] = own[k] ? values[k] * (whole / carried) : 0.;
  };
  give(nodes.area);
  for (std::vector<double> &component : nodes.push)
    give(component);
}
} // namespace mesoslip
