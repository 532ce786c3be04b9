#ifndef mesoslip_grid_row_partition_h
#define mesoslip_grid_row_partition_h

#include "grid/instruction_set.h"
#include "grid/nodal_field.h"

#include <mpi.h>
#include <stdexcept>

namespace mesoslip
{
/**
 * The node rows of a uniform grid that one rank works on: it owns [begin, end) of the
 * rows 0..n_global-1 and stores, in addition, ghost rows on each side that has a
 * neighbour. Fields on a slab hold n_local() rows, row `local(j)` being global row j.
 */
struct NodeRows
{
  unsigned int n_global = 0; ///< rows of the whole grid
  unsigned int begin    = 0; ///< first row owned
  unsigned int end      = 0; ///< one beyond the last row owned

  /** Ghost rows a side: one is enough for operators, n for n time steps at once. */
  unsigned int ghosts = 1;

  /** All rows on one rank. */
  static NodeRows all(const unsigned int n)
  {
    return {n, 0, n};
  }

  /** Whether a rank below owns rows. */
  bool has_lower_ghost() const
  {
    return begin > 0;
  }

  /** Whether a rank above owns rows. */
  bool has_upper_ghost() const
  {
    return end < n_global;
  }

  /** First stored row, global number. */
  unsigned int first() const
  {
    return begin > ghosts ? begin - ghosts : 0;
  }

  /** One past the last stored row, global number. */
  unsigned int last() const
  {
    return n_global - end > ghosts ? end + ghosts : n_global;
  }

  /** Owned rows and ghosts. */
  unsigned int n_local() const
  {
    return last() - first();
  }

  /** Row of a field that holds global row @p global_row. */
  unsigned int local(const unsigned int global_row) const
  {
    return global_row - first();
  }
};

/** How a sweep is run; never changes a bit of the result. */
struct SweepOptions
{
  InstructionSet isa = InstructionSet::automatic; ///< of the row kernels

  /** Time steps in one sweep of advance() (temporal blocking): 0 chooses by cache size, 1
   *  is the plain sweep. On a slab it is the number of ghost rows that counts, see
   *  partition_rows(). */
  unsigned int steps_at_once = 0;

  bool single_precision = false; ///< of the motion between the contact and the top
};

/**
 * Time steps in one sweep for a grid of @p n_columns x @p n_rows nodes over @p n_ranks
 * ranks:
 * @p requested or, if that is 0, what the size of the second-level cache suggests. A slab
 * needs as many ghost rows, and computes some rows twice: at most 3 % of them if chosen
 * here.
 */
unsigned int choose_steps_at_once(const unsigned int n_columns,
                                  const unsigned int n_rows,
                                  const unsigned int n_ranks,
                                  const unsigned int requested);

/** Over how many ranks @p n_rows node rows can be divided: two rows each, or one rank. */
unsigned int largest_number_of_ranks(const unsigned int n_rows);

/**
 * Contiguous slabs of node rows over the ranks of @p communicator, equal to two rows.
 * Rank 0 has the bottom. Every rank gets at least two rows: throws std::invalid_argument
 * when there are too many ranks. A stepper runs @p ghosts time steps at once, see
 * choose_steps_at_once().
 */
NodeRows partition_rows(const unsigned int n_rows,
                        MPI_Comm communicator,
                        const unsigned int ghosts = 1);

/** Slabs of a grid of @p n_columns x @p n_rows nodes for the steps at once of
 *  @p options. */
NodeRows partition_rows(const unsigned int n_columns,
                        const unsigned int n_rows,
                        MPI_Comm communicator,
                        const SweepOptions &options);

/** Fill the nearest ghost rows of @p field from the neighbours (blocking, collective). */
void update_ghost_rows(NodalField<double> &field,
                       const NodeRows &rows,
                       MPI_Comm communicator);

/** Collect the whole field on rank 0 (elsewhere the result is empty). */
NodalField<double>
gather_rows(const NodalField<double> &field, const NodeRows &rows, MPI_Comm communicator);

/**
 * Saves or restores the own rows of @p field in their place (Boost.Serialization); all else is
 * zero then. How many ghost rows a run has depends on the steps at once, and changes no result.
 * @throws std::length_error when a field of other extents was saved
 */
template <class Archive>
void serialize_own_rows(Archive &archive, NodalField<double> &field, const NodeRows &rows)
{
  if (Archive::is_loading::value)
    field.set_zero();
  const std::size_t size = (rows.end - rows.begin) * field.stride();
  std::size_t saved      = size;
  archive &saved;
  if (saved != size)
    throw std::length_error("a field of other extents was saved");
  // Rows begin with the column on the left.
  serialize_array(archive, field.row(0, rows.local(rows.begin)) - lanes<double>, size);
}
} // namespace mesoslip

#endif
