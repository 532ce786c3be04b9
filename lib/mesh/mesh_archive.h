#ifndef mesoslip_mesh_mesh_archive_h
#define mesoslip_mesh_mesh_archive_h

#include "base/serialize_members.h"
#include "mesh/mesh.h"

namespace mesoslip
{
/** A whole mesh (Boost.Serialization), for those who send one to another rank. */
template <class Archive, int dim>
void serialize(Archive &archive, Mesh<dim> &mesh, const unsigned int)
{
  serialize_members<7>(archive, mesh);
}
} // namespace mesoslip

#endif
