#ifndef mesoslip_elasticity_brick_plane_exchange_h
#define mesoslip_elasticity_brick_plane_exchange_h

#include "elasticity/brick/brick_slab.h"
#include "grid/nodal_field.h"

#include <functional>

namespace mesoslip
{
/** Ghost planes of nodes below and above the planes of a rank. */
class PlaneExchange
{
public:
  /** Exchange among the ranks of the slab. */
  PlaneExchange(const BrickSlab &slab, const MPI_Comm communicator);

  /**
   * Updates below() and above(); @p copy (plane, destination) writes a plane of this
   * rank. Collective.
   */
  void exchange(const std::function<void(unsigned int, double *)> &copy);

  /**
   * Copies @p n numbers of the last plane of each rank to the first plane of the next
   * rank. In a box periodic in y also copies the very first plane to the very last one.
   * Collective.
   */
  void pass(double *first, double *last, const std::size_t n) const;

  /** Ghost plane below, [rows + 1][3][stride]; zero if there is none. */
  const double *below() const
  {
    return received[0].data();
  }

  /** Ghost plane above, [rows + 1][3][stride]; zero if there is none. */
  const double *above() const
  {
    return received[1].data();
  }

private:
  const MPI_Comm communicator;
  const unsigned int last_plane;
  const bool is_periodic;
  int rank_below, rank_above; ///< neighbours, or MPI_PROC_NULL
  LineVector<double> sent[2], received[2];
};
} // namespace mesoslip

#endif
