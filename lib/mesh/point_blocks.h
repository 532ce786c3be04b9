#ifndef mesoslip_mesh_point_blocks_h
#define mesoslip_mesh_point_blocks_h

#include "mesh/mesh_part.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace dealii::Utilities::MPI
{
class NoncontiguousPartitioner;
} // namespace dealii::Utilities::MPI

namespace mesoslip
{
/** Block of a rank for @p n_all numbered items in groups of @p n_together: [begin, end),
 * the groups from r N / n to (r + 1) N / n. */
std::pair<std::size_t, std::size_t> block_of_rank(const std::size_t n_all,
                                                  const MPI_Comm communicator,
                                                  const std::size_t n_together = 1);

/**
 * Redistributes values of numbered items (points, cells) from their owners to contiguous
 * blocks, block_of_rank(), in the order of files; no rank gets all items.
 */
class NumberedBlocks
{
public:
  /** There are @p n_all items in groups of @p n_together; this rank owns the items
   * @p numbers, in any order. Collective. */
  NumberedBlocks(const std::vector<std::uint64_t> &numbers,
                 const std::size_t n_all,
                 const MPI_Comm communicator,
                 const std::size_t n_together = 1);

  /** First item in the block of this rank. */
  std::size_t first() const
  {
    return begin;
  }

  /** Number of items in the block of this rank. */
  std::size_t size() const
  {
    return end - begin;
  }

  /** A value per item of the block, from the values @p owned of this rank's items.
   * Collective. */
  void gather(const double *owned, std::vector<double> &block) const;

  /** Numbers [size()][count] per item of the block, from @p owned [n_owned][n]: @p count
   * of them from number @p first on. Collective. */
  std::vector<double> gather(const std::vector<double> &owned,
                             const std::size_t n,
                             const std::size_t first,
                             const std::size_t count) const;

private:
  const std::size_t n_owned;
  std::size_t begin = 0, end = 0;
  std::shared_ptr<const dealii::Utilities::MPI::NoncontiguousPartitioner> exchange;
};

/** The inverse of NumberedBlocks: sends values that were read in blocks to the ranks that
 * need them. */
class NumbersFromBlocks
{
public:
  /** This rank needs the items @p needed out of @p n_all, each once; several ranks may
   * need an item. Collective. */
  NumbersFromBlocks(const std::vector<unsigned int> &needed,
                    const std::size_t n_all,
                    const MPI_Comm communicator);

  /** First item in the block of this rank. */
  std::size_t first() const
  {
    return begin;
  }

  /** Number of items in the block of this rank. */
  std::size_t size() const
  {
    return end - begin;
  }

  /** @p n values per needed item, from the values [size()][n] of this rank's @p block.
   * Collective. */
  std::vector<double> bring(const std::vector<double> &block, const std::size_t n) const;

private:
  std::size_t begin = 0, end = 0;
  const std::size_t n_needed;
  std::shared_ptr<const dealii::Utilities::MPI::NoncontiguousPartitioner> exchange;
};

/**
 * Redistributes fields at the points of a partitioned mesh to the order of the whole
 * mesh, as NumberedBlocks.
 */
template <int dim>
class PointBlocks
{
public:
  /** The whole mesh has @p n_points, in groups of @p n_together. Collective. */
  PointBlocks(const MeshPart<dim> &part,
              const std::size_t n_points,
              const MPI_Comm communicator,
              const std::size_t n_together = 1);

  /** This rank owns the points @p numbers. Collective. */
  PointBlocks(const std::vector<std::uint64_t> &numbers,
              const std::size_t n_points,
              const MPI_Comm communicator,
              const std::size_t n_together = 1)
    : blocks(numbers, n_points, communicator, n_together)
  {
  }

  /** The first point of the block of this rank. */
  std::size_t first() const
  {
    return blocks.first();
  }

  /** Number of points in the block of this rank. */
  std::size_t size() const
  {
    return blocks.size();
  }

  /** Values [size()][dim] in the block from the values at locally owned points, in the
   * order of the part: @p owned [d] points at component d. Collective. */
  std::vector<double> gather(const std::array<const double *, dim> &owned) const;

private:
  const NumberedBlocks blocks;
};
} // namespace mesoslip

#endif
