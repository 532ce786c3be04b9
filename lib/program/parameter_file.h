#ifndef mesoslip_program_parameter_file_h
#define mesoslip_program_parameter_file_h

#include "parameters/raw_parameters.h"
#include "program/command_line.h"

#include <mpi.h>
#include <string>

namespace mesoslip
{
/** Reads the .prm, whose text goes to @p text, and the --set options; on all ranks.
 * @throws UserError */
RawParameters read_parameter_file(const CommandLine &line,
                                  const MPI_Comm communicator,
                                  std::string &text);
} // namespace mesoslip

#endif
