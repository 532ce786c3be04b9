#ifndef mesoslip_program_serve_h
#define mesoslip_program_serve_h

#include "program/program.h"

namespace mesoslip
{
/** Option --serve: carries out the command lines on standard input, each a JSON list of
 * words on a line, and answers each with status and message, until the input ends or a
 * run is interrupted.
 * @throws UserError */
void serve_runs(const Application &program);
} // namespace mesoslip

#endif
