#ifndef mesoslip_grid_row_partition_h
#define mesoslip_grid_row_partition_h

#include "grid/nodal_field.h"
#include "grid/node_rows.h"
#include "grid/sweep_options.h"

#include <mpi.h>

namespace mesoslip
{
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

/** A field without its ghost rows, or with empty ones. */
NodalField<double> own_rows(const NodalField<double> &field, const NodeRows &rows);

/** The field with empty ghost rows around its own. */
NodalField<double> with_ghost_rows(const NodalField<double> &own, const NodeRows &rows);

/**
 * Saves or restores the own rows of @p field (Boost.Serialization): how many ghost rows a
 * run has depends on the steps at once, and changes no result.
 */
template <class Archive>
void serialize_own_rows(Archive &archive, NodalField<double> &field, const NodeRows &rows)
{
  NodalField<double> own = own_rows(field, rows);
  archive &own;
  if (Archive::is_loading::value)
    field = with_ghost_rows(own, rows);
}
} // namespace mesoslip

#endif
