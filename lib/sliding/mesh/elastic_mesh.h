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
/** On rank 0: the cells behind the faces of the contact under the displacement @p u of @p elastic. Collective. */
template <int dim>
std::vector<ContactCell> cells_at_contact(const BodyMesh<dim> &morphology,
                                          const MeshBodyParameters &parameters,
                                          const PointBody<dim> &elastic,
                                          const NodalField<double> &u);

/** What groups of faces and top hold, all components of what platens move; with @p
 * contact_held the contact along the normal of the flat. */
template <int dim>
DofMask held_by_mesh(const MeshBodyDescription &body,
                     const TopSetup &top,
                     const bool contact_held,
                     const PointBody<dim> &elastic);

/** Number of components that all this leaves free, of the @p mesh that rank 0 has. Collective. */
template <int dim>
std::size_t n_free_on_mesh(const Mesh<dim> &mesh,
                           const MeshBodyDescription &body,
                           const TopSetup &top,
                           const bool contact_held);

/** The nodes of a side that a rank has in @p elastic. */
template <int dim>
SupportNodes nodes_of(const MeshSide &side, const PointBody<dim> &elastic);

/** Circular, of a node of top or sides that moves alone on its springs, the fastest one (1/s). Collective. */
template <int dim>
double frequency_of_springs(const DistributedBody<dim> &distributed,
                            const MeshBodyDescription &body,
                            const ContactParameters &parameters);

/** Puts the contact nodes of the description into the order of @p elastic. */
template <int dim>
void order_contact(MeshBodyDescription &body, const PointBody<dim> &elastic);
} // namespace mesoslip

#endif
