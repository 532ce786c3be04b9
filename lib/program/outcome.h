#ifndef mesoslip_program_outcome_h
#define mesoslip_program_outcome_h

#include "base/errors.h"

#include <mpi.h>
#include <string>

namespace mesoslip
{
/** Result of a run: exit status, and a sentence for the user. */
struct Outcome
{
  ExitStatus status = ExitStatus::done; ///< exit status
  std::string message;                  ///< empty on success
};

/**
 * Writes a sentence of @p speaker to stderr in one piece, not interleaved with output of
 * MPI and other ranks.
 */
void say(const std::string &speaker, const std::string &sentence);

/** Translates the exception being handled; call it in a catch block. */
Outcome describe_current_exception();

/**
 * The outcome of the first rank that failed, on all ranks. If some ranks fail and the
 * rest does not get here within ten seconds, the rest may wait for the failed ranks
 * forever: then the failed rank prints its error and ends the whole run.
 */
Outcome shared_outcome(const MPI_Comm communicator,
                       const std::string &program,
                       const Outcome &outcome);
} // namespace mesoslip

#endif
