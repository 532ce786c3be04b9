#ifndef mesoslip_base_collective_h
#define mesoslip_base_collective_h

#include <mpi.h>

#include <functional>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Runs @p work on rank 0 while the others wait; what it throws is thrown on all ranks
 * (UserError, NumericalFailure and Interrupted as such, others as std::runtime_error).
 * For reading files and anything else that only one rank does and that may fail.
 */
void on_root(const MPI_Comm communicator, const std::function<void()> &work);

/** Gives every rank the text of rank @p owner. */
void broadcast(const MPI_Comm communicator, std::string &text, const int owner = 0);

/** Gives rank 0 the text of rank @p owner; the other ranks keep theirs. */
void bring_to_root(const MPI_Comm communicator, std::string &text, const int owner);

/** The texts of all ranks on rank 0, in their order; elsewhere empty. */
std::vector<std::string> gather(const MPI_Comm communicator, const std::string &text);

/** Gives rank r the text r of rank 0. */
std::string scatter(const MPI_Comm communicator, const std::vector<std::string> &texts);

/** Whether mpirun (of Open MPI, or one with PMI) started this process. */
bool started_by_mpirun();

/**
 * What a process without mpirun does not need of Open MPI is left out of its start; call
 * before MPI_Init. No daemon for ranks that are spawned: a quarter of the time to start,
 * and it outlives a run that is killed. No session folder: processes that start and end
 * side by side share one and remove it under each other (one start of 200 fails).
 */
void prepare_mpi_of_one_process();
} // namespace mesoslip

#endif
