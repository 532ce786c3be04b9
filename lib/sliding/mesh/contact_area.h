#ifndef mesoslip_sliding_mesh_contact_area_h
#define mesoslip_sliding_mesh_contact_area_h

#include "sliding/mesh/mesh_body.h"

#include <string>

namespace mesoslip
{
/** Empty if all contact nodes have an area seen along the normal of the flat. */
std::string standing_faces_warning(const MeshBoundary &contact,
                                   const MeshBodyParameters &mesh);

/** That forces on the nodes are pressures. @throws UserError */
void require_contact_area(const MeshBodyDescription &body);
} // namespace mesoslip

#endif
