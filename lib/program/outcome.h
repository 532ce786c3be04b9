#ifndef mesoslip_program_outcome_h
#define mesoslip_program_outcome_h

#include "base/errors.h"

#include <mpi.h>
#include <string>

namespace mesoslip
{
/** How a run ended: status for the shell and sentence for the user. */
struct Outcome
{
  ExitStatus status = ExitStatus::done; ///< for the shell
  std::string message;                  ///< empty when all went well
};

/**
 * Writes a sentence of @p speaker on stderr in one piece: what MPI and other ranks write
 * at the same time comes before or after it.
 */
void say(const std::string &speaker, const std::string &sentence);

/** Translates the exception being handled; call it in a catch block. */
Outcome describe_current_exception();

/**
 * The outcome of the first rank that failed, on all ranks. If some ranks
 * fail and others do not get here within ten seconds, they wait for the failed ones
 * forever: then the failed rank prints its error and ends the whole run.
 */
Outcome shared_outcome(const MPI_Comm communicator,
                       const std::string &program,
                       const Outcome &outcome);
} // namespace mesoslip

#endif
