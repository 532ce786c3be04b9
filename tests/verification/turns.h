#ifndef mesoslip_tests_verification_turns_h
#define mesoslip_tests_verification_turns_h

#include <mpi.h>

namespace verification
{
/** Whether this rank has the case number @p k of those that need one rank: the ranks take
 * them in turns, so that together they do all of them once. */
inline bool has_turn(const unsigned int k)
{
  int rank = 0, n_ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
  return k % n_ranks == static_cast<unsigned int>(rank);
}
} // namespace verification

#endif
