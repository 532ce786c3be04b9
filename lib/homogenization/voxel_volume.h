#ifndef mesoslip_homogenization_voxel_volume_h
#define mesoslip_homogenization_voxel_volume_h

#include "elasticity/uniform_material.h"
#include "grid/uniform_grid.h"
#include "homogenization/response.h"

#include <functional>
#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * A volume element of voxels with the load cases of KUBC, SUBC and PBC: cells are
 * trilinear bricks. Nobody outside knows how they are solved; now it is a MeshVolume.
 */
class VoxelVolume
{
public:
  /** @p map is that of rank 0; @p phases (stiffness in Pa) are those of its cells.
   * Collective. @throws UserError */
  VoxelVolume(const PhaseMap<3> &map,
              const std::vector<ElasticPhase<3>> &phases,
              const MPI_Comm communicator);

  ~VoxelVolume();

  /**
   * Solves the load cases of @p condition: unit strains (KUBC, PBC; engineering shear) or
   * stresses of 1 Pa (SUBC). Collective. @throws NotConverged, which names condition and
   * load case. @p case_done, if any, is called after each load case.
   */
  VolumeSums<3> solve(const BoundaryCondition condition,
                      const double tolerance,
                      const std::function<void()> &case_done = {});

  /**
   * Concentration tensors of the cells for the condition that was solved last, as
   * HomogenizedResponse has them: on rank 0 of all cells, x fastest, on the other ranks
   * empty. Collective.
   */
  std::vector<double> concentration() const;

private:
  class Solver;
  std::unique_ptr<Solver> solver;
};
} // namespace mesoslip

#endif
