#include "program/machine.h"

#include "base/exchange.h"
namespace mesoslip
{
unsigned int ranks_of_this_machine()
{
  MPI_Comm here;
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
  const unsigned int n = mpi::n_mpi_processes(here);
  MPI_Comm_free(&here);
  return n;
}

double share_of_this_machine()
{
  return static_cast<double>(ranks_of_this_machine()) /
         mpi::n_mpi_processes(MPI_COMM_WORLD);
}
} // namespace mesoslip
