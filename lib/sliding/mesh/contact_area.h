#ifndef mesoslip_sliding_mesh_contact_area_h
#define mesoslip_sliding_mesh_contact_area_h

#include "sliding/mesh/mesh_body.h"

#include <string>

namespace mesoslip
{
/** Warning if contact nodes have no area seen along the normal of the flat; else
 * empty. */
std::string standing_faces_warning(const MeshBoundary &contact,
                                   const MeshBodyParameters &mesh);

/** Checks that the contact has an area, so that nodal forces give pressures.
 * @throws UserError */
void require_contact_area(const MeshBodyDescription &body);
} // namespace mesoslip

#endif
