#ifndef mesoslip_sliding_mesh_mesh_modal_h
#define mesoslip_sliding_mesh_mesh_modal_h

#include "program/program.h"
#include "sliding/contact_parameters.h"

#include <memory>

namespace mesoslip
{
/**
 * Analysis "modal" of a body on a mesh, in 2D or 3D as the parameters say: modes.csv,
 * modal.h5 and modal.xdmf. @throws UserError
 */
std::unique_ptr<Analysis> make_mesh_modal(const ContactParameters &parameters);
} // namespace mesoslip

#endif
