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
/** The first number in the block of a rank of @p n_all numbered things, @p n_together of them in a
 * group, and the one behind its last: from r N / n to (r + 1) N / n of the groups. */
std::pair<std::size_t, std::size_t> block_of_rank(const std::size_t n_all,
                                                  const MPI_Comm communicator,
                                                  const std::size_t n_together = 1);

/**
 * What ranks have of numbered things, such as points or cells, brought into the order of
 * their numbers so that no rank has all: each gets its block_of_rank(), as files have them.
 */
class NumberedBlocks
{
public:
  /** There are @p n_all things, of which this rank owns those called @p numbers, in any
   * order; @p n_together of them in a group. Collective. */
  NumberedBlocks(const std::vector<std::uint64_t> &numbers,
                 const std::size_t n_all,
                 const MPI_Comm communicator,
                 const std::size_t n_together = 1);

  /** The first number in the block of this rank. */
  std::size_t first() const
  {
    return begin;
  }

  /** How many are in the block of this rank. */
  std::size_t size() const
  {
    return end - begin;
  }

  /** One value of each in the block from those of what this rank @p owned. Collective. */
  void gather(const double *owned, std::vector<double> &block) const;

  /** Numbers [size()][count] of each in the block, from those that this rank @p owned
   * [n_owned][n]: @p count of them from number @p first on. Collective. */
  std::vector<double> gather(const std::vector<double> &owned,
                             const std::size_t n,
                             const std::size_t first,
                             const std::size_t count) const;

private:
  const std::size_t n_owned;
  std::size_t begin = 0, end = 0;
  std::shared_ptr<const dealii::Utilities::MPI::NoncontiguousPartitioner> exchange;
};

/** The way back: what ranks have read in blocks, brought to those that need it. */
class NumbersFromBlocks
{
public:
  /** Of @p n_all things this rank needs those called @p needed, each once, which others may need as
   * well. Collective. */
  NumbersFromBlocks(const std::vector<unsigned int> &needed,
                    const std::size_t n_all,
                    const MPI_Comm communicator);

  /** The first number in the block of this rank. */
  std::size_t first() const
  {
    return begin;
  }

  /** How many are in the block of this rank. */
  std::size_t size() const
  {
    return end - begin;
  }

  /** @p n values of each that is needed, from those in the @p block of this rank [size()][n].
   * Collective. */
  std::vector<double> bring(const std::vector<double> &block, const std::size_t n) const;

private:
  std::size_t begin = 0, end = 0;
  const std::size_t n_needed;
  std::shared_ptr<const dealii::Utilities::MPI::NoncontiguousPartitioner> exchange;
};

/**
 * Fields at the points of a mesh that is divided among the ranks, brought into the order of
 * the whole mesh as NumberedBlocks.
 */
template <int dim>
class PointBlocks
{
public:
  /** The whole mesh has @p n_points, @p n_together in a group. Collective. */
  PointBlocks(const MeshPart<dim> &part,
              const std::size_t n_points,
              const MPI_Comm communicator,
              const std::size_t n_together = 1);

  /** The same where this rank owns the points called @p numbers. Collective. */
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

  /** Values [size()][dim] in the block from those at the points that this rank owns, in
   * the order of its part: @p owned [d] points at component d. Collective. */
  std::vector<double> gather(const std::array<const double *, dim> &owned) const;

private:
  const NumberedBlocks blocks;
};
} // namespace mesoslip

#endif
