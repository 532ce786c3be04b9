#ifndef mesoslip_homogenization_rve_program_h
#define mesoslip_homogenization_rve_program_h

#include "program/program.h"

namespace mesoslip
{
/** The program rve_homogenization. */
Application rve_homogenization_program();
} // namespace mesoslip

#endif
