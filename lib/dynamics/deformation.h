#ifndef mesoslip_dynamics_deformation_h
#define mesoslip_dynamics_deformation_h

#include "elasticity/brick/brick_slab.h"
#include "grid/cell_planes.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"
#include "grid/uniform_grid.h"
#include "mesh/mesh_part.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <mpi.h>
#include <vector>

namespace mesoslip
{
/** The cell with the largest or smallest value of a quantity. */
struct CellExtreme
{
  double value                 = 0.; ///< value of the quantity
  std::uint64_t cell           = 0;  ///< number in the mesh; on a grid row by row
  std::array<double, 3> middle = {}; ///< centre of the cell (m)
};

/** Measures of the deviation from small strains and rotations; NaN counts as infinite. */
struct Deformation
{
  /** Largest norm sqrt(eps : eps) of the strain at the centre of a cell [-]. */
  CellExtreme strain;

  /** Largest rotation at the centre of a cell, half the norm of curl u [rad]. */
  CellExtreme rotation;

  /**
   * Smallest determinant of the deformation gradient 1 + grad u at a corner of a cell;
   * not positive if a cell is inverted [-].
   */
  CellExtreme jacobian = {std::numeric_limits<double>::infinity(), 0, {}};

  /** Largest strain that rounding of displacements takes or adds, see rounding_of_strain(); 0 in
   * double precision [-]. */
  double rounding = 0.;
};

/** The largest strains of a run. */
struct LargestStrain
{
  double strain   = 0.; ///< largest norm of the strain of a cell [-]
  double rounding = 0.; ///< largest Deformation::rounding [-]

  /** Takes what a look has @p found. */
  void add(const Deformation &found)
  {
    strain   = std::max(strain, found.strain.value);
    rounding = std::max(rounding, found.rounding);
  }

  /** Saves or restores both (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &strain &rounding;
  }
};

/** 2^-24 max |u_c| / h_c of all nodes of a grid, whose displacements @p u (m) were rounded to single
 * precision [-]. Collective. */
double rounding_of_strain(const UniformGrid<2> &grid,
                          const NodeRows &rows,
                          const NodalField<double> &u,
                          const MPI_Comm communicator);

/**
 * Extremes over all cells; among equal ones the first cell, so that the result does not
 * depend on the number of ranks. @p u (m) has the rows of @p rows with up-to-date ghost
 * rows. Collective.
 */
Deformation largest_deformation(const UniformGrid<2> &grid,
                                const NodeRows &rows,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);

/**
 * Extremes on a mesh. @p u (m) has a column for each of the @p points of a rank;
 * @p numbers are the numbers of its @p cells in the whole mesh. Collective.
 */
template <int dim>
Deformation largest_deformation(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<Cell> &cells,
                                const std::vector<unsigned int> &numbers,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);

/**
 * Extremes on a box of bricks of which a rank has @p planes across z. @p row(c, j, k)
 * points to the displacements (m) along axis c of a row of points along x, both ends
 * included. Collective.
 */
Deformation largest_deformation(
  const UniformGrid<3> &grid,
  const PlaneRange &planes,
  const std::function<const double *(unsigned int, unsigned int, unsigned int)> &row,
  const MPI_Comm communicator);

/**
 * Extremes on a slab of a box; @p u (m) has a column for each point of the part.
 * Collective.
 */
Deformation largest_deformation(const BrickSlab &slab,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);
} // namespace mesoslip

#endif
