#ifndef mesoslip_sliding_mesh_mesh_sides_h
#define mesoslip_sliding_mesh_mesh_sides_h

#include "sliding/mesh/mesh_body.h"

#include <vector>

namespace mesoslip
{
struct ContactParameters;

/** SideNodes::impedance of the points of an absorbing @p top, scaled by true area over
 * projected area. */
template <int dim>
std::vector<std::vector<double>>
impedance_of_points(const BodyMesh<dim> &morphology,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const MeshBoundary &top);

/**
 * Describes ContactParameters::loaded_sides() of a body whose constrained points are
 * known. A platen moves the points of its side except points of contact, top and earlier
 * platens, and points that other supports constrain in its direction. Components in
 * which platens do not move are constrained.
 * @throws UserError
 */
template <int dim>
void describe_sides(MeshBodyDescription &body,
                    const BodyMesh<dim> &morphology,
                    const std::vector<BoundaryFace<dim>> &faces,
                    const ContactParameters &given);
} // namespace mesoslip

#endif
