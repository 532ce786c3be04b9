#ifndef mesoslip_sliding_mesh_elastic_mesh_h
#define mesoslip_sliding_mesh_elastic_mesh_h

#include "body/mesh/mesh_body.h"
#include "elasticity/dof_mask.h"
#include "sliding/given_body.h"
#include "sliding/mesh/body_mesh.h"
#include "sliding/mesh/mesh_body.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace mesoslip
{
/** The body for statics and modes of the @p morphology that rank 0 has, with fields that are divided among the ranks;
 * or if @p whole, with whole ones, and then all ranks hold the whole mesh. Collective. */
template <int dim>
std::unique_ptr<MeshBody<dim>>
make_mesh_body(const BodyMesh<dim> &morphology,
               const std::vector<ElasticPhase<dim>> &phases,
               const MeshBodyDescription &body,
               const MeshBodyParameters &parameters,
               const MPI_Comm communicator,
               const bool whole);

/** On rank 0: the cells behind the faces of the contact under the displacement @p u of @p elastic. Collective. */
template <int dim>
std::vector<ContactCell> cells_at_contact(const BodyMesh<dim> &morphology,
                                          const MeshBodyParameters &parameters,
                                          const MeshBody<dim> &elastic,
                                          const NodalField<double> &u);

/** What groups of faces and top hold, of a platen the normal component as well; with @p
 * contact_held the contact along the normal of the flat. */
template <int dim>
DofMask held_by_mesh(const MeshBodyDescription &body,
                     const TopSetup &top,
                     const bool contact_held,
                     const MeshBody<dim> &elastic);

/** Number of components that all this leaves free, of the @p mesh that rank 0 has. Collective. */
template <int dim>
std::size_t n_free_on_mesh(const Mesh<dim> &mesh,
                           const MeshBodyDescription &body,
                           const TopSetup &top,
                           const bool contact_held);

/** Puts the contact nodes of the description into the order of @p elastic. */
template <int dim>
void order_contact(MeshBodyDescription &body, const MeshBody<dim> &elastic);
} // namespace mesoslip

#endif
