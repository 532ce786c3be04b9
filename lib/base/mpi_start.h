#ifndef mesoslip_base_mpi_start_h
#define mesoslip_base_mpi_start_h

namespace mesoslip
{
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
