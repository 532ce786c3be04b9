#include "contact/friction_law.h"

#include <cmath>

namespace mesoslip
{
SlipRateRegularization::SlipRateRegularization(const double length,
                                               const double reference_velocity)
  : length(length)
  , reference_velocity(reference_velocity)
{
}

void SlipRateRegularization::update(const SlidingNodes &nodes,
                                    const double dt,
                                    double * /*coefficient*/,
                                    double *decay) const
{
  const double rate = dt / length;
  for (unsigned int i = 0; i < nodes.n; ++i)
    decay[i] = std::exp(
      -rate * (std::fabs(nodes.flat_velocity - nodes.velocity[i]) + reference_velocity));
}
} // namespace mesoslip
