#ifndef mesoslip_contact_pair_surface_values_h
#define mesoslip_contact_pair_surface_values_h

#include "grid/nodal_field.h"

#include <limits>
#include <mpi.h>
#include <vector>

namespace mesoslip
{
/** Contact nodes on a rank: locally owned nodes, followed by ghost nodes. */
struct NodesOfContact
{
  /** Placeholder number of padding. */
  static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

  std::vector<unsigned int> number; ///< number in the whole contact, or none
  unsigned int n_owned = 0;         ///< number of locally owned nodes, the first ones

  /** Calls what (i, number in the whole contact) for all nodes except padding. */
  template <typename Function>
  void for_each(const Function &what) const
  {
    for (std::size_t i = 0; i < number.size(); ++i)
      if (number[i] != none)
        what(i, number[i]);
  }
};

/** Values at the nodes of a contact, sent by the owners of the nodes to all ranks. */
class SurfaceValues
{
public:
  /** @p n_rows values per node, initially zero. Collective. */
  SurfaceValues(const NodesOfContact &nodes,
                const unsigned int n_rows,
                const MPI_Comm communicator);

  /**
   * Sets row @p r from the @p values of the nodes of this rank; ghost nodes are ignored.
   */
  void set(const unsigned int r, const double *values);

  /** Sends the values to all ranks. Collective. */
  void share();

  /** Ranks that share the values. */
  MPI_Comm ranks() const
  {
    return communicator;
  }

  /** Number of nodes of the whole contact. */
  std::size_t n_nodes() const
  {
    return of_ranks.size();
  }

  /** Row @p r of all nodes, in the order of the whole contact. */
  const double *row(const unsigned int r) const
  {
    return whole.row(r, 0);
  }

private:
  const std::vector<unsigned int> owned; ///< numbers of the locally owned nodes
  const MPI_Comm communicator;
  std::vector<unsigned int> of_ranks; ///< owned numbers of all ranks, rank after rank
  std::vector<int> counts, starts;    ///< counts and offsets of the values of each rank
  std::vector<double> own, all;       ///< values of this rank, and of all ranks
  NodalField<double> whole;
};
} // namespace mesoslip

#endif
