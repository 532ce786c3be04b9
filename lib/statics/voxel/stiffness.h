#ifndef mesoslip_statics_voxel_stiffness_h
#define mesoslip_statics_voxel_stiffness_h

#include "elasticity/uniform_material.h"
#include "grid/cell_planes.h"
#include "statics/voxel/multigrid.h"

#include <array>
#include <memory>
#include <vector>

namespace mesoslip::voxel
{
/** Strain and stress added in all cells, in the units of SweepArguments. */
struct CellLoad
{
  std::array<double, 6> strain = {}; ///< Voigt, added to the strain of the displacements
  std::array<double, 6> stress = {}; ///< Voigt, subtracted
};

/**
 * Matrix-free stiffness of a box of voxels, exactly integrated trilinear bricks: stores
 * the phases of the cells of this rank and a table of the kernels' coefficients.
 * Displacements u (m) and forces f (N) have f / (modulus length) = K u.
 */
class Stiffness
{
public:
  /**
   * @p cells holds phase numbers (not needed later) in @p of_phases; densities are not
   * read. @p kind gives sides, periodic axes and whether it is flat; planes of nodes are
   * divided among the ranks of the cells. Collective.
   * @throws std::invalid_argument for a phase without a stiffness
   */
  Stiffness(const CellPlanes &cells,
            const std::vector<ElasticPhase<3>> &of_phases,
            const VoxelGrid &kind);

  const std::vector<ElasticPhase<3>> of_phases; ///< plane strain for flat grids
  const double length;                          ///< unit of length, edge along y (m)
  const VoxelGrid grid;                         ///< cells and nodes, edges in this unit
  const std::vector<double> n_cells;            ///< cells of each phase, on all ranks
  const CellIndices phases;                     ///< phase of each cell, [z][y][stride]
  const double modulus; ///< unit of stress, the largest entry of all stiffnesses (Pa)

  /** A preconditioner with the constrained components @p held, whose ghosts are set; it
   * refers to this object. Collective. */
  std::unique_ptr<Multigrid> make_multigrid(HeldComponents held) const;

  /** Residual forces: @p load minus K v, including constrained components; returns the
   * square of their norm. @p exact, unless null, gets them in double precision, in the
   * layout of @p v. Ghosts of @p v are set. Collective. */
  double forces(const CellLoad &load,
                VoxelField<double> &v,
                VoxelField<float> &out,
                double *exact = nullptr) const;

private:
  LineVector<double> make_table(const std::vector<ElasticPhase<3>> &of) const;
  std::size_t in_table(const unsigned int coefficient, const std::size_t phase) const;

  unsigned int n_coefficients = 0;              ///< see CellStiffness
  Source source               = Source::phases; ///< few phases, many phases or materials
  LineVector<double> table;          ///< coefficients of the phases, see SweepArguments
  LineVector<double> preconditioner; ///< the same for phase_to_precondition()
  double ratio = 1.;                 ///< largest over smallest stiffness
  mutable LineVector<double> work;
};
} // namespace mesoslip::voxel

#endif
