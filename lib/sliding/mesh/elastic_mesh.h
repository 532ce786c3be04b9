#ifndef mesoslip_sliding_mesh_elastic_mesh_h
#define mesoslip_sliding_mesh_elastic_mesh_h

#include "body/point_body.h"
#include "elasticity/dof_mask.h"
#include "sliding/given_body.h"
#include "sliding/mesh/body_mesh.h"
#include "sliding/mesh/mesh_body.h"

#include <cstddef>
#include <vector>

namespace mesoslip
{
/** The cells behind the contact faces under the displacement @p u of @p elastic, on rank
 * 0. Collective. */
template <int dim>
std::vector<ContactCell> cells_at_contact(const BodyMesh<dim> &morphology,
                                          const MeshBodyParameters &parameters,
                                          const PointBody<dim> &elastic,
                                          const NodalField<double> &u);

/** Constraints by face groups and top, including all components of nodes that platens
 * move; with @p contact_held the contact along the normal of the flat. */
template <int dim>
DofMask held_by_mesh(const MeshBodyDescription &body,
                     const TopSetup &top,
                     const bool contact_held,
                     const PointBody<dim> &elastic);

/** Number of free components under these constraints; @p mesh is on rank 0.
 * Collective. */
template <int dim>
std::size_t n_free_on_mesh(const Mesh<dim> &mesh,
                           const MeshBodyDescription &body,
                           const TopSetup &top,
                           const bool contact_held);

/** Locally stored nodes of a side in @p elastic. */
template <int dim>
SupportNodes nodes_of(const MeshSide &side, const PointBody<dim> &elastic);

/** Largest circular frequency (1/s) of a single node of top or sides on its springs.
 * Collective. */
template <int dim>
double frequency_of_springs(const DistributedBody<dim> &distributed,
                            const MeshBodyDescription &body,
                            const ContactParameters &parameters);

/** Sorts the contact nodes of the description into the order of @p elastic. */
template <int dim>
void order_contact(MeshBodyDescription &body, const PointBody<dim> &elastic);
} // namespace mesoslip

#endif
