#ifndef mesoslip_io_collective_h
#define mesoslip_io_collective_h

#include <mpi.h>

#include <functional>
#include <string>

namespace mesoslip
{
/**
 * Runs @p work on rank 0 while the others wait; what it throws is thrown on all ranks
 * (UserError, NumericalFailure and Interrupted as such, others as std::runtime_error).
 * For reading files and anything else that only one rank does and that may fail.
 */
void on_root(const MPI_Comm communicator, const std::function<void()> &work);

/** Gives every rank rank 0's text. */
void broadcast(const MPI_Comm communicator, std::string &text);
} // namespace mesoslip

#endif
