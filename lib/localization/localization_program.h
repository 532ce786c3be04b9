#ifndef mesoslip_localization_localization_program_h
#define mesoslip_localization_localization_program_h

#include "program/program.h"

namespace mesoslip
{
/** The application stress_localization; see run_program(). */
Application stress_localization_program();
} // namespace mesoslip

#endif
