#include "homogenization/voxel_volume.h"

#include "exchange/mesh_datasets.h"
#include "homogenization/mesh_volume.h"

namespace mesoslip
{
namespace
{
Mesh<3> mesh_of_voxels(const PhaseMap<3> &map, const std::size_t n_phases)
{
  if (map.id.empty())
    return {}; // not on rank 0
  Mesh<3> mesh = mesh_of_cells(map.grid);
  mesh.phases.resize(n_phases);
  for (std::size_t k = 0; k < map.id.size(); ++k)
    mesh.cells[k].material_id = map.id[k];
  return mesh;
}
} // namespace

/** The volume as a mesh of hexahedra. */
class VoxelVolume::Solver : public MeshVolume<3>
{
public:
  using MeshVolume<3>::MeshVolume;
};

VoxelVolume::VoxelVolume(const PhaseMap<3> &map,
                         const std::vector<ElasticPhase<3>> &phases,
                         const MPI_Comm communicator)
  : solver(
      std::make_unique<Solver>(mesh_of_voxels(map, phases.size()), phases, communicator))
{
}

VoxelVolume::~VoxelVolume() = default;

VolumeSums<3> VoxelVolume::solve(const BoundaryCondition condition,
                                 const double tolerance,
                                 const std::function<void()> &case_done)
{
  return solver->solve(condition, tolerance, case_done);
}

std::vector<double> VoxelVolume::concentration() const
{
  return solver->concentration();
}
} // namespace mesoslip
