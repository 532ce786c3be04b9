#include "sliding/supports/load_keys.h"

#include "base/errors.h"
#include "base/text.h"
#include "parameters/keys.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mesoslip
{
namespace
{
/** Binds expressions for the components of a vector, separated by semicolons, and calls
 * @p use (c, expression) for each of them. @p example is advice in messages. */
template <typename Use>
void bind_components(Keys &keys,
                     const std::string &key,
                     const unsigned int dim,
                     const std::string &example,
                     const std::string &meaning,
                     const Use &use)
{
  std::string all;
  keys.bind(key, all, meaning);
  std::istringstream text(all);
  std::string expression;
  for (unsigned int c = 0; std::getline(text, expression, ';'); ++c)
    {
      keys.require(c < dim, key,
                   "it has more than " + std::to_string(dim) +
                     " expressions; give one for each component");
      if (expression.find_first_not_of(" \t0") == std::string::npos)
        continue; // zero or empty
      double at_start = 0.;
      try
        {
          at_start = use(c, trimmed(expression));
        }
      catch (const std::invalid_argument &e)
        {
          throw UserError(keys.path(key) + ": " + e.what() + "; write for example " +
                          example);
        }
      keys.require(std::isfinite(at_start), key,
                   "at t = 0 it is " + to_text(at_start) +
                     "; write expressions that are finite at all times");
    }
}

} // namespace

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

void bind_suspension(Keys &keys,
                     Suspension &suspension,
                     const std::string &side,
                     const unsigned int dim)
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
       "Stiffness for the area along x, y and, in 3D, z of springs from " + side +
         " to a far end; 0 where it is left out" +
         (side == "the top" ? ". A platen moves along the flat only on springs" : "") +
         " [Pa/m]");
  bind("Dashpot", suspension.dashpot, "The same of dashpots beside the springs [Pa s/m]");
  keys.bind("Mass", suspension.mass, Range::non_negative(),
            "Mass for the area that moves with each node of " + side +
              "; Body/Acceleration acts on it [kg/m^2]");
  bind_components(
    keys, "Motion", dim, "1e-3*t; 0",
    "Displacement of the far end of springs and dashpots along x, y and, in 3D, z "
    "as expressions in the time t (s), separated by semicolons, e.g. 1e-3*t; 0. "
    "Components that are left out do not move; static contact takes the values at t = 0 "
    "[m]",
    [&](const unsigned int c, const std::string &expression) {
      suspension.motion[c] = LoadHistory(1., expression);
      return suspension.motion[c](0.);
    });
  bind_components(
    keys, "Traction", dim, "1e6*sin(pi*x/0.01); 0",
    "Traction on " + side +
      " besides its pressure, along x, y and, in 3D, z as expressions in x, y, z (m) and "
      "the time t (s), separated by semicolons; static contact takes it at t = 0 [Pa]",
    [&](const unsigned int c, const std::string &expression) {
      suspension.traction.set(c, expression);
      return suspension.traction(c, {}, 0.);
    });
}

void bind_platen_mass(Keys &keys, SideSupport &side, const std::string &what)
{
  keys.bind(
    "Platen mass", side.platen_mass, Range::non_negative(),
    "Mass of the platen, which moves with " + what +
      ", in 2D per unit thickness; Body/Acceleration does not act on it [kg/m, in "
      "3D kg]");
  keys.only_with("Kind", {"platen"}, {"Platen mass"});
}
} // namespace mesoslip
