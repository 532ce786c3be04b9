#ifndef mesoslip_tests_unit_contact_law_testing_h
#define mesoslip_tests_unit_contact_law_testing_h

#include "contact/laws/rate_and_state.h"
#include "contact/laws/stribeck.h"
#include "contact_testing.h"

namespace contact_testing
{
inline SlipPoint
at_rate(const double slip_rate, const double state = 0., const double pressure = 0.)
{
  SlipPoint at;
  at.slip_rate = slip_rate;
  at.state     = state;
  at.pressure  = pressure;
  return at;
}

inline Stribeck::Constants stribeck_constants()
{
  return {0.6, 0.35, 0.8, 1., 0.};
}

inline RateAndState::Constants rate_and_state_constants(const bool aging)
{
  return {0.6, 0.02, 0.03, 2e-3, 1e-3, 0.5, aging};
}
} // namespace contact_testing

#endif
