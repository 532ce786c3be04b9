#ifndef mesoslip_grid_halo_h
#define mesoslip_grid_halo_h

#include <mpi.h>

#include <cstddef>
#include <vector>

namespace mesoslip
{
/** Consecutive node rows of the state: pointers to the lowest one. */
struct RowBlock
{
  double *ux          = nullptr; ///< displacement (m)
  double *uy          = nullptr; ///< displacement (m)
  double *wx          = nullptr; ///< velocity of the scheme (m/s)
  double *wy          = nullptr; ///< velocity of the scheme (m/s)
  std::size_t stride  = 0;       ///< from one row to the next, in numbers
  unsigned int n_rows = 0;       ///< at least one
};

/**
 * Exchange with the ranks below and above, called by the stepper on a slab. Each sweep
 * goes from the lowest to the highest row, so the lowest own rows can be sent early and
 * the upper ghost rows are needed late; a rank that lags its lower neighbour by the
 * latency of a message never waits. Both neighbours call in the same order with the same
 * numbers of rows, and receive() what was sent before they send() again. Only sides that
 * have a neighbour are called.
 */
struct Halo
{
  /** Where the neighbour lies. */
  enum Side
  {
    lower,
    upper
  };

  virtual ~Halo() = default;

  /** The outermost own rows of a side are final for this time: start sending them. */
  virtual void send(const Side side, const RowBlock &own) = 0;

  /** Wait for the neighbour's rows and store them in the ghost rows. */
  virtual void receive(const Side side, const RowBlock &ghosts) = 0;

  /** Called now and then between rows: lets messages move. */
  virtual void progress() = 0;
};

/** The halo of a stepper over MPI: rank - 1 is below, rank + 1 above. */
class MPIHalo : public Halo
{
public:
  /** Rows of @p n_columns nodes, at most @p max_rows at a time. */
  MPIHalo(const unsigned int n_columns,
          const unsigned int max_rows,
          const MPI_Comm communicator);

  /** Every message sent has been received when all ranks have done their last step. */
  ~MPIHalo() override;
  MPIHalo(const MPIHalo &) = delete;

  void send(const Side side, const RowBlock &own) override;
  void receive(const Side side, const RowBlock &ghosts) override;
  void progress() override;

private:
  /** Numbers on their way to and from one neighbour. */
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
