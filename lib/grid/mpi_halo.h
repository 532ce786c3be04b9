#ifndef mesoslip_grid_mpi_halo_h
#define mesoslip_grid_mpi_halo_h

#include "grid/halo.h"
#include "grid/halo_channel.h"

#include <memory>
#include <mpi.h>

namespace mesoslip
{
/** The halo of a stepper over MPI: rank - 1 is below, rank + 1 above. */
class MPIHalo : public Halo
{
public:
  /** How rows get to a neighbour. */
  enum class Transport
  {
    /** Shared memory to a neighbour on the same node, messages to one elsewhere. */
    automatic,
    messages
  };

  /** Rows of @p n_columns nodes, at most @p max_rows at a time. Collective; so is the
   *  destructor. */
  MPIHalo(const unsigned int n_columns,
          const unsigned int max_rows,
          MPI_Comm communicator,
          const Transport transport = Transport::automatic);

  ~MPIHalo() override;

  void send(const Side side, const RowBlock &own) override;
  void receive(const Side side, const RowBlock &ghosts) override;
  void progress() override;

private:
  const unsigned int n_columns;
  std::unique_ptr<SharedSegments> shared;
  std::unique_ptr<HaloChannel> channels[2];
};
} // namespace mesoslip

#endif
