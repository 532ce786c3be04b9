#ifndef mesoslip_homogenization_voxel_volume_h
#define mesoslip_homogenization_voxel_volume_h

#include "elasticity/uniform_material.h"
#include "grid/uniform_grid.h"
#include "homogenization/volumes/volume_element.h"
#include "statics/voxel/solver.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/** A plane grid as a box one cell thick, whose z is the y of the plane. */
UniformGrid<3> in_space(const UniformGrid<2> &grid);

/**
 * A volume element of voxels whose planes across z, or of a plane grid whose rows the ranks divide among
 * themselves: cells are trilinear bricks, solved by voxel::Solver, in 2D by its flat case.
 */
template <int dim>
class VoxelVolume : public VolumeElement<dim>
{
public:
  using typename VolumeElement<dim>::Action;
  using typename VolumeElement<dim>::Sample;
  using typename VolumeElement<dim>::Values;

  /** Most phases of a plane grid. */
  static constexpr std::size_t most_phases = 255;

  /** @p the_cells, whose numbers have to outlive it, lie on @p the_grid (in 2D in_space()) and are made of
   * @p the_phases (stiffness in Pa). */
  VoxelVolume(const UniformGrid<dim> &the_grid,
              const CellPlanes &the_cells,
              const std::vector<ElasticPhase<dim>> &the_phases);

  VolumeSums<dim> solve(const BoundaryCondition wanted,
                        const double tolerance,
                        const std::function<void()> &case_done = {}) override;

  MPI_Comm communicator() const override
  {
    return cells.communicator;
  }
  void for_each(const Action &action) const override;
  void for_each_sample(const Sample &visit) const override;
  void write(const std::string &path,
             const std::vector<CellDataset> &datasets,
             const std::size_t n,
             const Values &values) const override;

private:
  VolumeSums<dim> integrate() const;

  /** The planes of cells of this rank; what every rank has (see voxel::Solver) counts as rank 0's. */
  PlaneRange planes() const;

  const UniformGrid<dim> grid;
  const CellPlanes cells;
  std::vector<ElasticPhase<3>> phases;                   ///< in space
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  std::unique_ptr<voxel::Solver> solver;                 ///< of it
};

/** How often the ranks of this machine hold a volume of so many cells along its last axis:
 *  their share of it or, if that is too few to divide them, each of them all. Collective. */
double copies_on_this_machine(const unsigned int n_cells);
} // namespace mesoslip

#endif
