#ifndef mesoslip_homogenization_loads_volume_cells_h
#define mesoslip_homogenization_loads_volume_cells_h

#include "body/elastic_body.h"
#include "grid/uniform_grid.h"
#include "homogenization/flat_volume.h"
#include "homogenization/load_cases.h"
#include "homogenization/loads/volume_element_cells.h"
#include "homogenization/mesh_volume.h"
#include "homogenization/voxel_volume.h"

#include <type_traits>

namespace mesoslip
{
/** The cells of a plane grid; all of them on the rank that has the solutions. */
class GridCells : public VolumeElementCells<2>
{
public:
  /** The solutions of @p body, the cells of which are those of @p grid. */
  GridCells(const ElasticBody<2> &body,
            const LoadCaseSolutions &solutions,
            const UniformGrid<2> &grid);

  MPI_Comm communicator() const override
  {
    return MPI_COMM_SELF;
  }
  void for_each(const Action &action) const override;
  void write(const std::string &path,
             const std::vector<CellDataset> &datasets,
             const std::size_t n,
             const Values &values) const override;

private:
  const ElasticBody<2> &body;
  const LoadCaseSolutions &solutions;
  const UniformGrid<2> grid;
};

/** The cells of a mesh that is divided among the ranks. */
template <int dim>
class MeshCells : public VolumeElementCells<dim>
{
public:
  using typename VolumeElementCells<dim>::Action;
  using typename VolumeElementCells<dim>::Values;

  /** Those of the condition that @p the_volume has solved last. */
  explicit MeshCells(const MeshVolume<dim> &the_volume)
    : volume(the_volume)
  {
  }

  MPI_Comm communicator() const override
  {
    return volume.communicator();
  }
  void for_each(const Action &action) const override;
  void write(const std::string &path,
             const std::vector<CellDataset> &datasets,
             const std::size_t n,
             const Values &values) const override;

private:
  const MeshVolume<dim> &volume;
};

/** What VoxelCells has the cells of. */
template <int dim>
using DividedVolume = std::conditional_t<dim == 2, FlatVolume, VoxelVolume>;

/** The cells of voxels, of which the ranks have planes, or of a plane grid, of which they have
 *  rows. */
template <int dim>
class VoxelCells : public VolumeElementCells<dim>
{
public:
  using typename VolumeElementCells<dim>::Action;
  using typename VolumeElementCells<dim>::Values;

  /** Those of the condition that @p the_volume has solved last; they lie on @p the_grid. */
  VoxelCells(const DividedVolume<dim> &the_volume,
             const UniformGrid<dim> &the_grid,
             const MPI_Comm ranks)
    : volume(the_volume)
    , grid(the_grid)
    , ranks(ranks)
  {
  }

  MPI_Comm communicator() const override
  {
    return ranks;
  }
  void for_each(const Action &action) const override;
  void write(const std::string &path,
             const std::vector<CellDataset> &datasets,
             const std::size_t n,
             const Values &values) const override;

private:
  void for_plane(const unsigned int k, const Action &action) const;

  const DividedVolume<dim> &volume;
  const UniformGrid<dim> grid;
  const MPI_Comm ranks;
};
} // namespace mesoslip

#endif
