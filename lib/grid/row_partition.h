#ifndef mesoslip_grid_row_partition_h
#define mesoslip_grid_row_partition_h

#include "grid/instruction_set.h"
#include "grid/nodal_field.h"

#include <mpi.h>
#include <stdexcept>

namespace mesoslip
{
/**
 * Node rows of a uniform grid on one rank. The rank owns rows [begin, end) of
 * 0..n_global-1, and stores ghost rows on each side that has a neighbour. Fields on a
 * slab have n_local() rows; row `local(j)` is global row j.
 */
struct NodeRows
{
  unsigned int n_global = 0; ///< rows of the whole grid
  unsigned int begin    = 0; ///< first locally owned row
  unsigned int end      = 0; ///< one past the last locally owned row

  /** Ghost rows per side: one for operators, n for n time steps at once. */
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

  /** Number of stored rows: locally owned rows and ghosts. */
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

/** How a sweep is run; no option changes a bit of the result. */
struct SweepOptions
{
  InstructionSet isa = InstructionSet::automatic; ///< instruction set of the row kernels

  /**
   * Time steps per sweep of advance() (temporal blocking): 0 chooses by cache size, 1 is
   * the plain sweep. On a slab the number of ghost rows decides, see partition_rows().
   */
  unsigned int steps_at_once = 0;

  bool single_precision = false; ///< motion between contact and top, on plane grids
};

/**
 * Time steps per sweep for a grid of @p n_columns x @p n_rows nodes on @p n_ranks ranks:
 * @p requested or, if it is 0, a value that fits the second-level cache. A slab needs as
 * many ghost rows and computes some rows twice, at most 3 % of them if chosen here.
 */
unsigned int choose_steps_at_once(const unsigned int n_columns,
                                  const unsigned int n_rows,
                                  const unsigned int n_ranks,
                                  const unsigned int requested);

/** Largest number of ranks for @p n_rows node rows: two rows each, or one rank. */
unsigned int largest_number_of_ranks(const unsigned int n_rows);

/**
 * Contiguous slabs of node rows over the ranks of @p communicator; sizes differ by at
 * most two rows. Rank 0 has the bottom. Every rank gets at least two rows; throws
 * std::invalid_argument if there are too many ranks. A stepper runs @p ghosts time steps
 * at once, see choose_steps_at_once().
 */
NodeRows partition_rows(const unsigned int n_rows,
                        MPI_Comm communicator,
                        const unsigned int ghosts = 1);

/**
 * Slabs of a grid of @p n_columns x @p n_rows nodes with the ghost rows that @p options
 * needs.
 */
NodeRows partition_rows(const unsigned int n_columns,
                        const unsigned int n_rows,
                        MPI_Comm communicator,
                        const SweepOptions &options);

/** Updates the nearest ghost rows of @p field (blocking, collective). */
void update_ghost_rows(NodalField<double> &field,
                       const NodeRows &rows,
                       MPI_Comm communicator);

/** Gathers the whole field on rank 0; the result is empty on other ranks. */
NodalField<double>
gather_rows(const NodalField<double> &field, const NodeRows &rows, MPI_Comm communicator);

/**
 * Saves or restores the locally owned rows of @p field (Boost.Serialization); after
 * loading, all other values are zero. The number of ghost rows depends on the steps at
 * once and does not affect results. @throws std::length_error if the saved field has
 * another size
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
  // Rows begin with the ghost column on the left.
  serialize_array(archive, field.row(0, rows.local(rows.begin)) - lanes<double>, size);
}
} // namespace mesoslip

#endif
