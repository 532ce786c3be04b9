#ifndef mesoslip_program_interrupt_h
#define mesoslip_program_interrupt_h

#include <string>

namespace mesoslip
{
/**
 * From here on SIGINT and SIGTERM ask for a stop; another one, two seconds or more
 * later, ends the process at once with status 130. (Terminals, timeout and mpirun may
 * deliver one request twice.) run_program() calls it.
 */
void install_interrupt_handlers();

/** Whether a signal asked for a stop. Local to the process. */
bool interrupt_received();

/** Whether somebody put a file `terminate` into @p folder. */
bool terminate_file_exists(const std::string &folder);
} // namespace mesoslip

#endif
