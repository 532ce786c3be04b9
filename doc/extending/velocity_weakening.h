#ifndef velocity_weakening_h
#define velocity_weakening_h

#include <contact/contact_surface.h>

#include <cmath>

/** mu = mu_d + (mu_s - mu_d) exp(-|V_rel| / V_c), from mu_s at rest to mu_d when fast. */
class VelocityWeakening : public mesoslip::NodeLaw
{
public:
  /** @param critical_velocity V_c (m/s) */
  VelocityWeakening(const double at_rest,
                    const double fast,
                    const double critical_velocity)
    : at_rest(at_rest)
    , fast(fast)
    , critical_velocity(critical_velocity)
  {
  }

  void update(const mesoslip::SlidingNodes &nodes,
              double /*dt*/,
              const mesoslip::NodeFriction &friction) const override
  {
    for (unsigned int i = 0; i < nodes.n; ++i)
      {
        const double slip_rate = std::fabs(nodes.flat_velocity - nodes.velocity[i]);
        friction.coefficient[i] =
          fast + (at_rest - fast) * std::exp(-slip_rate / critical_velocity);
      }
  }

private:
  double at_rest, fast, critical_velocity;
};

#endif
