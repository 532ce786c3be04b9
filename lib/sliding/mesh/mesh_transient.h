#ifndef mesoslip_sliding_mesh_mesh_transient_h
#define mesoslip_sliding_mesh_mesh_transient_h

#include "program/program.h"
#include "sliding/contact_parameters.h"

#include <memory>

namespace mesoslip
{
class Keys;

/**
 * Explicit dynamics of a body on a mesh, in 2D or 3D as the parameters say: reads and
 * checks the mesh on rank 0. @p keys identify the run. @throws UserError
 */
std::unique_ptr<Analysis> make_mesh_transient(const ContactParameters &parameters,
                                              const Keys &keys);
} // namespace mesoslip

#endif
