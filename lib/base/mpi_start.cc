#include "base/mpi_start.h"

#include <cstdlib>
#include <initializer_list>

namespace mesoslip
{
bool started_by_mpirun()
{
  for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    if (std::getenv(name) != nullptr)
      return true;
  return false;
}

void prepare_mpi_of_one_process()
{
  if (started_by_mpirun())
    return;
  ::setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  ::setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
}
} // namespace mesoslip
