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
 * A volume element of voxels with the load cases of KUBC, SUBC and PBC: cells are
 * trilinear bricks, solved by voxel::Solver. All members are collective.
 */
class VoxelVolume
{
public:
  /** @p map is that of rank 0; @p the_phases (stiffness in Pa) are those of its cells. */
  VoxelVolume(const PhaseMap<3> &map,
              const std::vector<ElasticPhase<3>> &the_phases,
              const MPI_Comm the_communicator);

  /**
   * Solves the load cases of @p wanted: unit strains (KUBC, PBC; engineering shear)
   * or stresses of 1 Pa (SUBC). @throws NotConverged, which names condition and load case.
   * @p case_done, if any, is called after each load case.
   */
  VolumeSums<3> solve(const BoundaryCondition wanted,
                      const double tolerance,
                      const std::function<void()> &case_done = {});

  /**
   * Concentration tensors of the cells for the condition that was solved last, as
   * HomogenizedResponse has them: on rank 0 of all cells, x fastest, on the other ranks
   * empty.
   */
  std::vector<double> concentration() const;

private:
  VolumeSums<3> integrate();
  std::vector<double> own_concentration() const;

  const PhaseMap<3> &map;
  const std::vector<ElasticPhase<3>> phases;
  const MPI_Comm communicator;
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  std::unique_ptr<voxel::Solver> solver;                 ///< of it
};
} // namespace mesoslip

#endif
