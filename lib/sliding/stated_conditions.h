#ifndef mesoslip_sliding_stated_conditions_h
#define mesoslip_sliding_stated_conditions_h

#include "exchange/run_conditions.h"
#include "sliding/contact_parameters.h"

namespace mesoslip
{
/**
 * What the parameters say of the conditions of a transient run or a static contact
 * analysis; time step and steady part are known only at the end of a run.
 */
RunConditions stated_conditions(const ContactParameters &parameters);
} // namespace mesoslip

#endif
