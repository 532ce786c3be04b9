#ifndef mesoslip_sliding_mesh_mesh_file_h
#define mesoslip_sliding_mesh_mesh_file_h

#include "io/hdf5_file.h"
#include "sliding/mesh/mesh_body.h"

#include <string>

namespace mesoslip
{
/** Begins a file of contact_dynamics on a mesh: header of @p format, mesh and materials. */
template <int dim>
Hdf5File create_mesh_file(const std::string &path,
                          const std::string &format,
                          const MeshMorphology<dim> &morphology,
                          const MeshBodyDescription &body);

/**
 * Writes @p path for ParaView with the phases of the cells in such a file, which is called
 * @p file: data of nodes and of cells cannot be shown in one.
 */
template <int dim>
void show_mesh_phases(const std::string &path,
                      const std::string &file,
                      const MeshMorphology<dim> &morphology);
} // namespace mesoslip

#endif
