#ifndef mesoslip_body_mesh_mesh_share_h
#define mesoslip_body_mesh_mesh_share_h

#include "body/mesh/distributed_mesh.h"
#include "body/mesh/mesh_outline.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * A partitioned mesh and the part of it that the fields of a rank need. Distributed
 * fields have the cells of the rank and all their points: first locally owned periodic
 * masters, then locally owned periodic copies, then ghost points.
 */
template <int dim>
struct MeshShare
{
  using Index = dealii::types::global_dof_index; ///< number of a degree of freedom

  MeshOutline<dim> outline;                              ///< outline of the whole mesh
  std::unique_ptr<const DistributedMesh<dim>> all_ranks; ///< the whole mesh, partitioned

  bool is_divided = false;                 ///< whether fields are distributed
  Mesh<dim> mesh;                          ///< points and cells of the local fields
  std::vector<unsigned int> point_in_mesh; ///< numbers of the points in the whole mesh
  std::vector<unsigned int> cell_in_mesh;  ///< numbers of the cells in the whole mesh
  std::size_t n_counted = 0; ///< locally owned points that are periodic masters
  std::size_t n_owned   = 0; ///< locally owned points
  std::vector<Index> dofs;   ///< degrees of freedom, dim per point
  std::vector<Index> copies; ///< whole mesh: dim pairs (copy, master) per periodic copy
};

/**
 * Share for replicated fields of the body @p given, which is the same on all ranks.
 * Collective. @throws UserError as outline_of()
 */
template <int dim>
MeshShare<dim> whole_share(const MeshBodyInput<dim> &given, const MPI_Comm communicator);

/**
 * Share for distributed fields. Only rank 0 needs @p mesh, which replaces the mesh of
 * @p given. Collective. @throws UserError as outline_of()
 */
template <int dim>
MeshShare<dim> divided_share(const Mesh<dim> &mesh,
                             const MeshBodyInput<dim> &given,
                             const MPI_Comm communicator);
} // namespace mesoslip

#endif
