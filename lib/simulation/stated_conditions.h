#ifndef mesoslip_simulation_stated_conditions_h
#define mesoslip_simulation_stated_conditions_h

#include "observation/run_conditions.h"
#include "simulation/contact_parameters.h"

namespace mesoslip
{
/**
 * What the parameters say of the conditions of a transient run or a static contact
 * analysis; time step and steady part are known only at the end of a run.
 */
RunConditions stated_conditions(const ContactParameters &parameters);
} // namespace mesoslip

#endif
