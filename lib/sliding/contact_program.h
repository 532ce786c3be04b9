#ifndef mesoslip_sliding_contact_program_h
#define mesoslip_sliding_contact_program_h

#include "program/program.h"

namespace mesoslip
{
/** The program contact_dynamics. */
Application contact_dynamics_program();
} // namespace mesoslip

#endif
