#ifndef mesoslip_elasticity_row_partition_h
#define mesoslip_elasticity_row_partition_h

#include "elasticity/explicit_stepper.h"
#include "elasticity/node_rows.h"
#include "grid/nodal_field.h"

#include <memory>
#include <mpi.h>

namespace mesoslip
{
/**
 * Contiguous slabs of node rows over the ranks of @p communicator, equal to one row. Rank
 * 0 has the bottom. Every rank gets at least two rows: throws std::invalid_argument when
 * there are too many ranks.
 */
NodeRows partition_rows(const unsigned int n_rows, MPI_Comm communicator);

/** Fill the ghost rows of @p field from the neighbours (blocking, collective). */
void update_ghost_rows(NodalField<double> &field,
                       const NodeRows &rows,
                       MPI_Comm communicator);

/** Collect the whole field on rank 0 (elsewhere the result is empty). */
NodalField<double>
gather_rows(const NodalField<double> &field, const NodeRows &rows, MPI_Comm communicator);

/** Distribute a whole field of rank 0 to the slabs, ghost rows included. */
NodalField<double> scatter_rows(const NodalField<double> &whole,
                                const unsigned int n_columns,
                                const NodeRows &rows,
                                MPI_Comm communicator);

/** The halo of a stepper over MPI: nonblocking messages to rank - 1 and rank + 1. */
class MPIHalo : public Halo
{
public:
  MPIHalo(const unsigned int n_columns, MPI_Comm communicator);
  ~MPIHalo() override;

  void send_lower(const RowState &own_lowest) override;
  void send_upper(const RowState &own_highest) override;
  void receive_lower(const RowState &ghost) override;
  void receive_upper(const RowState &ghost) override;
  void progress() override;

private:
  struct Side;
  std::unique_ptr<Side> lower;
  std::unique_ptr<Side> upper;
  unsigned int n_columns;
};
} // namespace mesoslip

#endif
