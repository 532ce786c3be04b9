#ifndef mesoslip_grid_halo_h
#define mesoslip_grid_halo_h

#include <cstddef>

namespace mesoslip
{
/** Consecutive node rows of the state: pointers to the lowest one. */
struct RowBlock
{
  double *ux = nullptr; ///< displacement (m)
  double *uy = nullptr; ///< displacement (m)
  double *wx = nullptr; ///< velocity of the scheme (m/s)
  double *wy = nullptr; ///< velocity of the scheme (m/s)

  /** From one row to the next, in numbers. */
  std::size_t stride = 0;

  unsigned int n_rows = 0; ///< at least one
};

/**
 * Exchange with the ranks below and above, called by the stepper on a slab. Each sweep
 * goes from the lowest to the highest row, so the lowest own rows can be sent early and
 * the upper ghost rows are needed late; a rank that lags its lower neighbour by the
 * latency of a message never waits. Both neighbours call in the same order with the same
 * numbers of rows. Only sides that have a neighbour are called.
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
  virtual void progress()
  {
  }
};
} // namespace mesoslip

#endif
