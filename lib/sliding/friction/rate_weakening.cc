#include "sliding/friction/rate_weakening.h"

#include "material/plausibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
double RateWeakening::fastest_growth() const
{
  const double r = fall / impedance;
  double high    = std::numeric_limits<double>::infinity();
  if (lag() < 0.)
    return -1. / lag();
  if (lag() > 0.)
    high = (r - 1.) / lag();
  if (beta > 0.)
    high = std::min(high, (r * r - 1.) / beta);
  if (lag() == 0. || beta == 0.)
    return high;
  double low = 0.;
  for (unsigned int n = 0; n < 100; ++n)
    {
      const double s                                                 = 0.5 * (low + high);
      (std::sqrt(1. + beta * s) * (1. + lag() * s) < r ? low : high) = s;
    }
  return high;
}

std::string RateWeakening::text(const std::string &where) const
{
  return "falls by up to " + quantity_text(fall, "Pa s/m") + " with the slip rate " +
         where + ", more than the " +
         (lag() < 0. ? quantity_text(delta * stiffness, "Pa s/m") +
                         " that Flat/Tangential stiffness times the regularization time "
                         "allows"
                     : quantity_text(impedance, "Pa s/m") +
                         " that shear waves into the body resist (density times wave "
                         "speed)");
}
} // namespace mesoslip
