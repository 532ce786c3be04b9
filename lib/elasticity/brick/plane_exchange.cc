#include "elasticity/brick/plane_exchange.h"

#include "base/exchange.h"
namespace mesoslip
{
namespace
{
constexpr int upwards = 83, downwards = 84; ///< message tags
}

PlaneExchange::PlaneExchange(const BrickSlab &slab, const MPI_Comm communicator)
  : communicator(communicator)
  , last_plane(slab.n_planes - 1)
  , is_periodic(slab.box.periodic[1])
{
  const int n  = static_cast<int>(mpi::n_mpi_processes(communicator)),
            me = static_cast<int>(mpi::this_mpi_process(communicator));
  rank_below   = me > 0 ? me - 1 : slab.box.periodic[1] ? n - 1 : MPI_PROC_NULL;
  rank_above   = me + 1 < n ? me + 1 : slab.box.periodic[1] ? 0 : MPI_PROC_NULL;
  for (auto *planes : {sent, received})
    for (unsigned int side = 0; side < 2; ++side)
      planes[side].resize((std::size_t{slab.n_nodes[1]} + 1) * 3 * slab.stride +
                          lanes<double>);
}

void PlaneExchange::exchange(const std::function<void(unsigned int, double *)> &copy)
{
  // The first plane is the last one of the rank below, which needs the second one.
  if (rank_below != MPI_PROC_NULL)
    copy(1, sent[0].data());
  if (rank_above != MPI_PROC_NULL)
    copy(last_plane - 1, sent[1].data());
  const int size = static_cast<int>(sent[0].size());
  MPI_Sendrecv(sent[0].data(), size, MPI_DOUBLE, rank_below, downwards,
               received[1].data(), size, MPI_DOUBLE, rank_above, downwards, communicator,
               MPI_STATUS_IGNORE);
  MPI_Sendrecv(sent[1].data(), size, MPI_DOUBLE, rank_above, upwards, received[0].data(),
               size, MPI_DOUBLE, rank_below, upwards, communicator, MPI_STATUS_IGNORE);
}

void PlaneExchange::pass(double *first, double *last, const std::size_t n) const
{
  const int ranks     = static_cast<int>(mpi::n_mpi_processes(communicator)),
            me        = static_cast<int>(mpi::this_mpi_process(communicator)),
            size      = static_cast<int>(n);
  const bool is_first = me == 0, is_last = me + 1 == ranks;
  MPI_Sendrecv(last, size, MPI_DOUBLE, is_last ? MPI_PROC_NULL : me + 1, upwards, first,
               size, MPI_DOUBLE, is_first ? MPI_PROC_NULL : me - 1, upwards, communicator,
               MPI_STATUS_IGNORE);
  if (!is_periodic || ranks == 1)
    return;
  MPI_Sendrecv(first, size, MPI_DOUBLE, is_first ? ranks - 1 : MPI_PROC_NULL, downwards,
               last, size, MPI_DOUBLE, is_last ? 0 : MPI_PROC_NULL, downwards,
               communicator, MPI_STATUS_IGNORE);
}
} // namespace mesoslip
