#ifndef mesoslip_sliding_complex_steady_friction_h
#define mesoslip_sliding_complex_steady_friction_h

#include "contact/laws/slip_law.h"
#include "eigenvalues/complex/sliding_pencil.h"

namespace mesoslip
{
/** A law of the coefficient about steady sliding. */
struct SteadyFriction
{
  double coefficient = 0.; ///< mu after long sliding
  FrictionSlopes slopes;   ///< how the coefficient changes with slip rate and pressure
  double state_time = 0.;  ///< in which the state follows the slip rate (s); 0: no state
};

/**
 * @p law at the slip rate (above 0), pressure and place of @p at, its state being that of long sliding.
 * With a state theta, d theta/dt = g(V, theta), steady theta_s(V), the slope at once is
 * dmu/dV at this theta; what the state adds, d mu(V, theta_s(V))/dV less that, follows within
 * -1/(dg/dtheta), which is found from SlipLaw::next_state(). A state that grows without an
 * end, as the slip, takes no part.
 * @throws UserError for a law that depends on time, whose state does not become steady, or
 * that is not defined there
 */
SteadyFriction steady_friction(const SlipLaw &law, SlipPoint at);
} // namespace mesoslip

#endif
