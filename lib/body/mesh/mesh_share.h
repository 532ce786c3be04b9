#ifndef mesoslip_body_mesh_mesh_share_h
#define mesoslip_body_mesh_mesh_share_h

#include "body/mesh/distributed_mesh.h"
#include "body/mesh/mesh_outline.h"

#include <memory>
#include <vector>

namespace mesoslip
{
/**
 * A mesh that is divided among the ranks, and what one of them has for fields: of divided
 * ones its cells and all their points, first those whose degrees of freedom the rank owns
 * and that move on their own, then others that it owns, then those of other ranks.
 */
template <int dim>
struct MeshShare
{
  using Index = dealii::types::global_dof_index; ///< a degree of freedom

  MeshOutline<dim> outline;                              ///< of the whole mesh
  std::unique_ptr<const DistributedMesh<dim>> all_ranks; ///< the whole mesh

  bool is_divided = false;                 ///< whether fields are
  Mesh<dim> mesh;                          ///< points and cells of fields
  std::vector<unsigned int> point_in_mesh; ///< numbers of the points in the whole mesh
  std::vector<unsigned int> cell_in_mesh;  ///< those of the cells
  std::size_t n_counted = 0; ///< points that the rank owns and that move on their own
  std::size_t n_owned   = 0; ///< points that the rank owns
  std::vector<Index> dofs;   ///< dim a point
  std::vector<Index>
    duplicates; ///< of the whole mesh: dim of a duplicate, of its original
};

/** For whole fields of the body @p given, which is the same on all ranks. Collective. @throws
 * UserError as outline_of() */
template <int dim>
MeshShare<dim> whole_share(const MeshBodyInput<dim> &given, const MPI_Comm communicator);

/** For divided fields. Only rank 0 has to have @p mesh, which stands in for that of @p given.
 * Collective. @throws UserError as outline_of() */
template <int dim>
MeshShare<dim> divided_share(const Mesh<dim> &mesh,
                             const MeshBodyInput<dim> &given,
                             const MPI_Comm communicator);
} // namespace mesoslip

#endif
