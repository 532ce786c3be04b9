#ifndef mesoslip_sliding_mesh_mesh_file_h
#define mesoslip_sliding_mesh_mesh_file_h

#include "body/point_body.h"
#include "exchange/xdmf.h"
#include "io/hdf5_file.h"
#include "sliding/mesh/body_mesh.h"

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Creates a file of contact_dynamics on a box or a mesh with header, cells and
 * materials. The format name is @p format plus, for a mesh, "-mesh"; the digests
 * identify its content and its RVE file. */
template <int dim>
Hdf5File create_mesh_file(const std::string &path,
                          const std::string &format,
                          const BodyMesh<dim> &body,
                          const std::string &digest,
                          const std::string &rve_digest);

/**
 * Writes @p fields of @p elastic as the rows of dataset @p name. All ranks write a block
 * of points each; rank 0, which has the @p file and its @p body, closes the file
 * meanwhile. Collective.
 */
template <int dim>
void write_divided_fields(std::optional<Hdf5File> &file,
                          const std::string &path,
                          const std::string &name,
                          const std::vector<const NodalField<double> *> &fields,
                          const BodyMesh<dim> &body,
                          const PointBody<dim> &elastic);
} // namespace mesoslip

#endif
