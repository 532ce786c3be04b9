#ifndef mesoslip_elasticity_brick_plane_exchange_h
#define mesoslip_elasticity_brick_plane_exchange_h

#include "elasticity/brick/brick_slab.h"
#include "grid/nodal_field.h"

#include <functional>

namespace mesoslip
{
/** The planes of nodes below and above those of a rank, which other ranks advance. */
class PlaneExchange
{
public:
  /** Of the ranks of the slab. */
  PlaneExchange(const BrickSlab &slab, const MPI_Comm communicator);

  /** Sets below and above; @p copy (plane, where to) writes a plane of this rank. Collective. */
  void exchange(const std::function<void(unsigned int, double *)> &copy);

  /** Gives the first plane of each rank but the first what the rank below has in its last one,
   * @p n numbers; of a box periodic in y also the very last one what is in the very first.
   * Collective. */
  void pass(double *first, double *last, const std::size_t n) const;

  /** [rows + 1][3][stride], zero where there is no plane. */
  const double *below() const
  {
    return received[0].data();
  }

  /** The same above. */
  const double *above() const
  {
    return received[1].data();
  }

private:
  const MPI_Comm communicator;
  const unsigned int last_plane;
  const bool is_periodic;
  int rank_below, rank_above; ///< or MPI_PROC_NULL
  LineVector<double> sent[2], received[2];
};
} // namespace mesoslip

#endif
