#ifndef mesoslip_homogenization_voxel_volume_h
#define mesoslip_homogenization_voxel_volume_h

#include "elasticity/uniform_material.h"
#include "grid/uniform_grid.h"
#include "homogenization/response.h"
#include "statics/voxel/solver.h"

#include <functional>
#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * A volume element of voxels with the load cases of KUBC, SUBC, PBC and MUBC: cells are
 * trilinear bricks, solved by voxel::Solver. Collective where nothing else is said.
 */
class VoxelVolume
{
public:
  /** Cells, whose numbers have to outlive it, are made of @p the_phases (stiffness in Pa). @p
   * is_flat: see voxel::Solver; what is not in the plane of x and z has no meaning. */
  VoxelVolume(const CellPlanes &the_cells,
              const std::vector<ElasticPhase<3>> &the_phases,
              const bool is_flat = false);

  /**
   * Solves the load cases of @p wanted: unit strains (KUBC, PBC, MUBC; engineering
   * shear) or stresses of 1 Pa (SUBC). @throws NotConverged, which names condition and load case.
   * @p case_done, if any, is called after each load case.
   */
  VolumeSums<3> solve(const BoundaryCondition wanted,
                      const double tolerance,
                      const std::function<void()> &case_done = {});

  /** What the cells are made of. Not collective. */
  const CellPlanes &materials() const
  {
    return cells;
  }

  /** The first plane of cells across z of this rank, and their number; what every rank has
   *  (see voxel::Solver) counts as rank 0's. */
  std::array<unsigned int, 2> planes() const;

  /**
   * Concentration tensors, as HomogenizedResponse has them, of the cells of plane @p k of
   * those, [ny][nx][6][6], for the condition that was solved last. Not collective.
   */
  std::vector<double> concentration(const unsigned int k) const;

  /** Calls action(phase, strain) with the mean strains of each cell of plane @p k of those,
   * a column for each load case (SUBC: for 1 Pa), x fastest. Not collective. */
  void for_each_cell(
    const unsigned int k,
    const std::function<void(const unsigned int, const VoigtMatrix<3> &)> &action) const;

private:
  VolumeSums<3> integrate();

  const CellPlanes cells;
  const std::vector<ElasticPhase<3>> phases;
  const bool flat;
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  std::unique_ptr<voxel::Solver> solver;                 ///< of it
};

/** How often the ranks of this machine hold a volume of so many cells along its last axis:
 *  their share of it or, if that is too few to divide them, each of them all. Collective. */
double copies_on_this_machine(const unsigned int n_cells);
} // namespace mesoslip

#endif
