#ifndef mesoslip_sliding_mesh_mesh_sides_h
#define mesoslip_sliding_mesh_mesh_sides_h

#include "sliding/mesh/mesh_body.h"

#include <vector>

namespace mesoslip
{
struct ContactParameters;

/** SideNodes::impedance of the points of a @p top that absorbs: for the area seen from above that of the true one. */
template <int dim>
std::vector<std::vector<double>>
impedance_of_points(const BodyMesh<dim> &morphology,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const MeshBoundary &top);

/**
 * Describes ContactParameters::loaded_sides() of a body whose held points are known. Platens have the points that they
 * move: not those of contact and top, of a platen before, and those that other supports hold where it moves. Components
 * in which they do not move are held. @throws UserError
 */
template <int dim>
void describe_sides(MeshBodyDescription &body,
                    const BodyMesh<dim> &morphology,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const ContactParameters &given);
} // namespace mesoslip

#endif
