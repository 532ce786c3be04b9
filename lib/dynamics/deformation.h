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
/** The cell with the largest or smallest value of something. */
struct CellExtreme
{
  double value                 = 0.; ///< of the quantity
  std::uint64_t cell           = 0;  ///< its number in the mesh; of a grid row by row
  std::array<double, 3> middle = {}; ///< of the cell (m)
};

/** How far a body is from small strains and rotations; NaN counts as infinite. */
struct Deformation
{
  /** Largest norm sqrt(eps : eps) of the strain in the middle of a cell [-]. */
  CellExtreme strain;

  /** Largest rotation in the middle of a cell, half the norm of curl u [rad]. */
  CellExtreme rotation;

  /**
   * Smallest determinant of the deformation gradient 1 + grad u at a corner of a cell; a
   * cell is turned inside out where it is not positive [-].
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
 * The extremes over all cells, the first of equal ones in the order of the cells, so that
 * they do not depend on the number of ranks. @p u has the rows of @p rows with up-to-date
 * ghost rows (m). Collective.
 */
Deformation largest_deformation(const UniformGrid<2> &grid,
                                const NodeRows &rows,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);

/** The same on a mesh, where @p u (m) has a column for each of the @p points of a rank, and @p
 * numbers are those of its @p cells in the whole mesh. Collective. */
template <int dim>
Deformation largest_deformation(const std::vector<dealii::Point<dim>> &points,
                                const std::vector<Cell> &cells,
                                const std::vector<unsigned int> &numbers,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);

/** The same on a box of bricks of which a rank has some @p planes across z; @p row(c, j, k) begins the
 * displacements (m) along axis c of the points of a row along x, those at both ends included.
 * Collective. */
Deformation largest_deformation(
  const UniformGrid<3> &grid,
  const PlaneRange &planes,
  const std::function<const double *(unsigned int, unsigned int, unsigned int)> &row,
  const MPI_Comm communicator);

/** The same on a slab of such a box, where @p u (m) has a column for each point of the part.
 * Collective. */
Deformation largest_deformation(const BrickSlab &slab,
                                const NodalField<double> &u,
                                const MPI_Comm communicator);
} // namespace mesoslip

#endif
