#ifndef mesoslip_mesh_point_blocks_h
#define mesoslip_mesh_point_blocks_h

#include "mesh/mesh_part.h"

#include <deal.II/base/mpi_noncontiguous_partitioner.h>

namespace mesoslip
{
/**
 * Fields at the points of a mesh that is divided among the ranks, brought into the order of
 * the whole mesh so that no rank has all of them: rank r of n gets the points from r N / n
 * to (r + 1) N / n, as files have them.
 */
template <int dim>
class PointBlocks
{
public:
  /** The whole mesh has @p n_points. Collective. */
  PointBlocks(const MeshPart<dim> &part,
              const std::size_t n_points,
              const MPI_Comm communicator);

  /** The first point of the block of this rank. */
  std::size_t first() const
  {
    return begin;
  }

  /** Number of points in the block of this rank. */
  std::size_t size() const
  {
    return end - begin;
  }

  /** Values [size()][dim] in the block from those at the points that this rank owns, in
   * the order of its part: @p owned [d] points at component d. Collective. */
  std::vector<double> gather(const std::array<const double *, dim> &owned) const;

private:
  const std::size_t n_owned;
  std::size_t begin = 0, end = 0;
  dealii::Utilities::MPI::NoncontiguousPartitioner exchange;
};
} // namespace mesoslip

#endif
