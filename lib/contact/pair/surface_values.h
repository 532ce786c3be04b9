#ifndef mesoslip_contact_pair_surface_values_h
#define mesoslip_contact_pair_surface_values_h

#include "grid/nodal_field.h"

#include <limits>
#include <mpi.h>
#include <vector>

namespace mesoslip
{
/** The nodes of a contact that a rank has: those that it owns and, behind them, copies. */
struct NodesOfContact
{
  /** No node: what stands for one where arrays are filled up. */
  static constexpr unsigned int none = std::numeric_limits<unsigned int>::max();

  std::vector<unsigned int> number; ///< of each in the whole contact, or none
  unsigned int n_owned = 0;         ///< the first ones

  /** Calls what (i, number in the whole contact) for the nodes that are some. */
  template <typename Function>
  void for_each(const Function &what) const
  {
    for (std::size_t i = 0; i < number.size(); ++i)
      if (number[i] != none)
        what(i, number[i]);
  }
};

/** Some numbers for each node of a contact, which the ranks that own the nodes tell all others. */
class SurfaceValues
{
public:
  /** @p n_rows numbers a node, zero at first. Collective. */
  SurfaceValues(const NodesOfContact &nodes,
                const unsigned int n_rows,
                const MPI_Comm communicator);

  /** Takes number @p r of the nodes of this rank, of which copies are left out. */
  void set(const unsigned int r, const double *values);

  /** Tells all ranks what was set. Collective. */
  void share();

  /** Those that share them. */
  MPI_Comm ranks() const
  {
    return communicator;
  }

  /** Number of nodes of the whole contact. */
  std::size_t n_nodes() const
  {
    return of_ranks.size();
  }

  /** Number @p r of all nodes, in the order of the whole contact. */
  const double *row(const unsigned int r) const
  {
    return whole.row(r, 0);
  }

private:
  const std::vector<unsigned int> owned; ///< numbers of the nodes of this rank
  const MPI_Comm communicator;
  std::vector<unsigned int> of_ranks; ///< the same of all ranks, one after the other
  std::vector<int> counts, starts;    ///< of the values of each rank
  std::vector<double> own, all;       ///< values of this rank, and of all
  NodalField<double> whole;
};
} // namespace mesoslip

#endif
