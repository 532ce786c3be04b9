#ifndef mesoslip_sliding_complex_steady_friction_h
#define mesoslip_sliding_complex_steady_friction_h

#include "contact/laws/coefficient_law.h"
#include "eigenvalues/complex/sliding_pencil.h"

namespace mesoslip
{
/** A coefficient law linearized about steady sliding. */
struct SteadyFriction
{
  double coefficient = 0.; ///< mu after long sliding
  FrictionSlopes slopes;   ///< derivatives by slip rate and pressure
  double state_time = 0.;  ///< time constant of the state variable (s); 0: no state
};

/**
 * Linearizes @p law at the slip rate (above 0), pressure and place of @p at, with the
 * state of long sliding. With a state theta, d theta/dt = g(V, theta) and steady
 * theta_s(V), the instantaneous slope is dmu/dV at this theta. The rest of the slope, d
 * mu(V, theta_s(V))/dV minus the instantaneous slope, follows with the time constant
 * -1/(dg/dtheta), which is computed from CoefficientLaw::next_state(). A state that grows
 * without bound, such as the slip, is ignored.
 * @throws UserError for a law that depends on time, has no steady state, or is not
 * defined there
 */
SteadyFriction steady_friction(const CoefficientLaw &law, SlipPoint at);
} // namespace mesoslip

#endif
