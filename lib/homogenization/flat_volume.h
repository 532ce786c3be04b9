#ifndef mesoslip_homogenization_flat_volume_h
#define mesoslip_homogenization_flat_volume_h

#include "homogenization/voxel_volume.h"

#include <functional>
#include <vector>

namespace mesoslip
{
/**
 * A volume element on a plane grid whose rows the ranks divide among themselves: the flat
 * case of VoxelVolume, whose z is y here. Collective where nothing else is said.
 */
class FlatVolume
{
public:
  /** Most phases. */
  static constexpr std::size_t most_phases = 255;

  /** @p phase_id is that of rank 0, of the cells of @p grid, x fastest, which are not needed
   * later; @p the_phases (stiffness in Pa) are those of its cells. Collective. */
  FlatVolume(const UniformGrid<2> &grid,
             const CellView &phase_id,
             const std::vector<ElasticPhase<2>> &the_phases,
             const MPI_Comm communicator);

  /** As VoxelVolume::solve(). @throws NotConverged */
  VolumeSums<2> solve(const BoundaryCondition wanted,
                      const double tolerance,
                      const std::function<void()> &case_done = {});

  /** What the cells are made of; the planes are rows here. Not collective. */
  const CellPlanes &materials() const
  {
    return volume.materials();
  }

  /** The first row of cells of this rank and their number, see VoxelVolume::planes(). */
  std::array<unsigned int, 2> planes() const
  {
    return volume.planes();
  }

  /** Concentration tensors of the cells of row @p k of those, [nx][3][3], for the condition
   * that was solved last. Not collective. */
  std::vector<double> concentration(const unsigned int k) const;

  /** Calls action(phase, strain) with the mean strains of each cell of row @p k of those, a
   * column for each load case (SUBC: for 1 Pa). Not collective. */
  void for_each_cell(
    const unsigned int k,
    const std::function<void(const unsigned int, const VoigtMatrix<2> &)> &action) const;

private:
  const std::vector<ElasticPhase<2>> phases;
  const CellIndices rows; ///< phases of the cells of this rank
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  VoxelVolume volume;
};
} // namespace mesoslip

#endif
