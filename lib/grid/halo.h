#ifndef mesoslip_grid_halo_h
#define mesoslip_grid_halo_h

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace mesoslip
{
/** Consecutive node rows of the state; pointers to the lowest row. */
struct RowBlock
{
  double *ux          = nullptr; ///< displacement (m)
  double *uy          = nullptr; ///< displacement (m)
  double *wx          = nullptr; ///< velocity of the scheme (m/s)
  double *wy          = nullptr; ///< velocity of the scheme (m/s)
  std::size_t stride  = 0;       ///< distance between rows, in numbers
  unsigned int n_rows = 0;       ///< at least one
};

/**
 * Exchange of rows with the ranks below and above, called by the stepper on a slab. Each
 * sweep goes from the lowest to the highest row: the lowest owned rows are sent early,
 * the upper ghost rows are needed late. A rank that lags its lower neighbour by the
 * latency of a message never waits. Both neighbours make matching calls with the same
 * numbers of rows, and call receive() before the next send(). Called only for sides with
 * a neighbour.
 */
struct Halo
{
  /** Side of the neighbour. */
  enum Side
  {
    lower,
    upper
  };

  virtual ~Halo() = default;

  /**
   * Starts sending the outermost owned rows of a side, which are final for this time
   * step.
   */
  virtual void send(const Side side, const RowBlock &own) = 0;

  /** Waits for the rows of the neighbour and stores them in the ghost rows. */
  virtual void receive(const Side side, const RowBlock &ghosts) = 0;

  /** Called occasionally between rows so that MPI can progress messages. */
  virtual void progress() = 0;
};

/** Halo over MPI: rank - 1 is below, rank + 1 above. */
class MPIHalo : public Halo
{
public:
  /** Rows of @p n_columns nodes, at most @p max_rows at a time. */
  MPIHalo(const unsigned int n_columns,
          const unsigned int max_rows,
          const MPI_Comm communicator);

  /** All messages have been received once every rank has done its last step. */
  ~MPIHalo() override;
  MPIHalo(const MPIHalo &) = delete;

  void send(const Side side, const RowBlock &own) override;
  void receive(const Side side, const RowBlock &ghosts) override;
  void progress() override;

private:
  /** Send and receive buffers for one neighbour. */
  struct Neighbour
  {
    std::vector<double> out, in;
    std::vector<MPI_Request> sending, receiving;
  };

  const unsigned int n_columns;
  const MPI_Comm communicator;
  int rank = 0;
  Neighbour neighbours[2];
};
} // namespace mesoslip

#endif
