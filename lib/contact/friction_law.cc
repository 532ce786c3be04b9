#include "contact/friction_law.h"

#include <cmath>

namespace mesoslip
{
// The weights come from 1 - exp(-x), which keeps its digits for small x = dt / delta.
Relaxation::Relaxation(const double dt, const double delta)
  : decay(0.)
  , lag(0.)
{
  if (delta > 0.)
    {
      const double x = dt / delta, relaxed = -std::expm1(-x);
      decay = 1. - relaxed;
      lag   = x > 0. ? relaxed / x : 1.;
    }
}

SlipRateRegularization::SlipRateRegularization(const double length,
                                               const double reference_velocity)
  : length(length)
  , reference_velocity(reference_velocity)
{
}

void SlipRateRegularization::update(const SlidingNodes &nodes,
                                    const double dt,
                                    const NodeFriction &friction) const
{
  for (unsigned int i = 0; i < nodes.n; ++i)
    {
      const double slip_rate = std::fabs(nodes.flat_velocity - nodes.velocity[i]);
      friction.set(i, Relaxation(dt, length / (slip_rate + reference_velocity)));
    }
}
} // namespace mesoslip
