#ifndef mesoslip_dynamics_deformation_h
#define mesoslip_dynamics_deformation_h

#include "grid/nodal_field.h"
#include "grid/row_partition.h"
#include "grid/uniform_grid.h"

#include <limits>
#include <mpi.h>

namespace mesoslip
{
/** The cell with the largest or smallest value of something. */
struct CellExtreme
{
  double value        = 0.; ///< of the quantity
  unsigned int column = 0;  ///< of the cell
  unsigned int row    = 0;  ///< of the cell
};

/** How far a body is from small strains and rotations; NaN counts as infinite. */
struct Deformation
{
  /** Largest norm sqrt(eps : eps) of the mean strain of a cell [-]. */
  CellExtreme strain;

  /** Largest mean rotation of a cell, |du_y/dx - du_x/dy| / 2 [rad]. */
  CellExtreme rotation;

  /**
   * Smallest determinant of the deformation gradient 1 + grad u at a corner of a cell; a
   * cell is turned inside out where it is not positive [-].
   */
  CellExtreme jacobian = {std::numeric_limits<double>::infinity(), 0, 0};
};

/**
 * The extremes over all cells, the first of equal ones in the order of the cells, so that
 * they do not depend on the number of ranks. @p u has the rows of @p rows with up-to-date
 * ghost rows (m). Collective.
 */
Deformation largest_deformation(const UniformGrid<2> &grid,
                                const NodeRows &rows,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);
} // namespace mesoslip

#endif
