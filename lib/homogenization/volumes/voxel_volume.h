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
/** The plane grid as a box one cell thick; z of the box is y of the plane. */
UniformGrid<3> in_space(const UniformGrid<2> &grid);

/**
 * A volume element of voxels, or of a plane grid, of trilinear bricks. The ranks divide
 * the planes across z (2D: the rows). Solved by voxel::Solver, in 2D by its flat case.
 */
template <int dim>
class VoxelVolume : public VolumeElement<dim>
{
public:
  using typename VolumeElement<dim>::Action;
  using typename VolumeElement<dim>::Sample;
  using typename VolumeElement<dim>::Values;

  /** Largest number of phases of a plane grid. */
  static constexpr std::size_t most_phases = 255;

  /** @p the_cells, which must outlive this object, lie on @p the_grid (in 2D in_space())
   * and consist of @p the_phases (stiffness in Pa). */
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

  /** Locally owned planes of cells. A replicated volume (see voxel::Solver) belongs to
   * rank 0. */
  PlaneRange planes() const;

  const UniformGrid<dim> grid;
  const CellPlanes cells;
  std::vector<ElasticPhase<3>> phases; ///< stiffness and density of phases, in 3D
  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  std::unique_ptr<voxel::Solver> solver;                 ///< solver of `condition`
};

/** Number of copies of a volume with @p n_cells along its last axis that the ranks of
 * this machine hold: their share of one volume, or one copy per rank if the volume is
 * too small to divide. Collective. */
double copies_on_this_machine(const unsigned int n_cells);
} // namespace mesoslip

#endif
