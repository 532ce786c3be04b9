#ifndef mesoslip_sliding_mesh_box_body_h
#define mesoslip_sliding_mesh_box_body_h

#include "mesh/boundary.h"
#include "sliding/contact_parameters.h"

namespace mesoslip
{
/**
 * A grid in 3D as a body with the groups Left, Right (lower and upper x), Front, Back (y),
 * Contact and Top (z), and phases as @p parameters have them after with_phases(). Transient
 * runs need no mesh but that of the cells at the sides and near the probes; that of other
 * analyses is whole. On rank 0, whose machine has @p n_here of all @p n_ranks.
 * @throws UserError naming the key or file, also when the machine has not the memory
 */
MeshMorphology<3> make_box(const ContactParameters &parameters,
                           const unsigned int n_here  = 1,
                           const unsigned int n_ranks = 1);

/** Gives the other ranks the box of @p body, which rank 0 has, and its materials. Collective.
 * @throws UserError when they cannot open the file */
void share_box(const BodyParameters &parameters, MeshMorphology<3> &body);

/** The faces of the mesh on the side of the box whose name is number @p side of the groups. */
std::vector<BoundaryFace<3>> faces_of_side(const MeshMorphology<3> &body,
                                           const unsigned int side);

/** The cells of the mesh that hold @p points or touch such cells. */
std::vector<unsigned int> cells_near(const MeshMorphology<3> &body,
                                     const std::vector<ProbePoint> &points);
} // namespace mesoslip

#endif
