#ifndef mesoslip_base_exchange_h
#define mesoslip_base_exchange_h

#include "base/archive.h"
#include "base/collective.h"

#include <deal.II/base/mpi.h>

namespace mesoslip
{
/**
 * Gives every rank the @p object of rank @p owner. Objects travel whole, so that no
 * member can be left behind: their serialize() is best made of serialize_members().
 */
template <typename T>
void broadcast_object(const MPI_Comm communicator, T &object, const int owner = 0)
{
  if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
    object = dealii::Utilities::MPI::broadcast(communicator, object, owner);
}

/** Gives rank 0 the @p object of rank @p owner, whole; the other ranks keep theirs. */
template <typename T>
void bring_object_to_root(const MPI_Comm communicator, T &object, const int owner)
{
  const int rank =
    static_cast<int>(dealii::Utilities::MPI::this_mpi_process(communicator));
  std::string message = rank == owner ? save_state(object) : std::string();
  bring_to_root(communicator, message, owner);
  if (rank == 0 && owner != 0)
    load_state(message, object, "the message of another process");
}
} // namespace mesoslip

#endif
