#ifndef mesoslip_simulation_contact_program_h
#define mesoslip_simulation_contact_program_h

#include "io/program.h"

namespace mesoslip
{
/** The program contact_dynamics. */
Program contact_dynamics_program();
} // namespace mesoslip

#endif
