#include "contact/laws/friction_expression.h"

#include <limits>
#include <vector>

namespace mesoslip
{
namespace
{
enum FrictionVariable : std::size_t
{
  slip_rate,
  slip,
  pressure,
  moment,
  place_x,
  place_y
};

std::vector<std::string> friction_variables(const unsigned int dim)
{
  std::vector<std::string> names = {"V", "D", "p", "t", "x"};
  if (dim == 3)
    names.emplace_back("y");
  return names;
}
} // namespace

FrictionExpression::FrictionExpression(const std::string &text,
                                       const unsigned int dim,
                                       const Healing &healing)
  : expression(std::make_unique<Expression>(
      text,
      friction_variables(dim),
      "a coefficient is a function of V, D, p, t and the place"))
  , healing(healing)
  , values(friction_variables(dim).size())
{
}

double FrictionExpression::coefficient(const SlipPoint &at) const
{
  const double all[] = {at.slip_rate, at.state,       at.pressure,
                        at.time,      at.position[0], at.position[1]};
  values.assign(all, all + values.size());
  const double found = (*expression)(values);
  return found >= 0. ? found : std::numeric_limits<double>::quiet_NaN();
}

double FrictionExpression::slope(const SlipPoint &at) const
{
  if (!expression->has(slip_rate))
    return 0.;
  const double width = std::fmax(1e-6 * at.slip_rate, 1e-9);
  SlipPoint below = at, above = at;
  below.slip_rate = std::fmax(0., at.slip_rate - width);
  above.slip_rate = at.slip_rate + width;
  return (coefficient(above) - coefficient(below)) / (above.slip_rate - below.slip_rate);
}

std::optional<StateVariable> FrictionExpression::state() const
{
  return has_slip() ? std::optional<StateVariable>({"slip", "m", 0.}) : std::nullopt;
}

double FrictionExpression::next_state(const double state, const SlipStep &step) const
{
  return healing.next_slip(state, step);
}

double FrictionExpression::largest(const double fastest) const
{
  if (looks_around() || has_slip())
    return std::numeric_limits<double>::infinity();
  double most = 0.;
  for (int k = 0; k <= 100; ++k)
    {
      SlipPoint at;
      at.slip_rate = 0.01 * k * fastest;
      most         = std::fmax(most, coefficient(at));
    }
  return most;
}

bool FrictionExpression::looks_around() const
{
  return expression->has(pressure) || expression->has(moment) ||
         expression->has(place_x) ||
         (values.size() > place_y && expression->has(place_y));
}

bool FrictionExpression::has_slip() const
{
  return expression->has(slip);
}
} // namespace mesoslip
