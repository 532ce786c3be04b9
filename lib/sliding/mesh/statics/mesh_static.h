#ifndef mesoslip_sliding_mesh_statics_mesh_static_h
#define mesoslip_sliding_mesh_statics_mesh_static_h

#include "program/program.h"
#include "sliding/contact_parameters.h"

#include <memory>

namespace mesoslip
{
/**
 * Analysis "static contact" of a body on a mesh, in 2D or 3D as the parameters say:
 * static_contact.csv, static.h5 and static.xdmf. @throws UserError
 */
std::unique_ptr<Analysis> make_mesh_static(const ContactParameters &parameters);
} // namespace mesoslip

#endif
