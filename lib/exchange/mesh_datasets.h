#ifndef mesoslip_exchange_mesh_datasets_h
#define mesoslip_exchange_mesh_datasets_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <string>

namespace mesoslip
{
/** Number of integers in the topology of write_mesh(). */
template <int dim>
std::size_t topology_size(const Mesh<dim> &mesh);

/**
 * Writes corners and cells of @p mesh to the HDF5 file: /mesh/points [n][dim] in m, and
 * /mesh/topology with kind and corners of each cell in the format of XDMF's mixed
 * topology (kinds 4 triangle, 5 quadrilateral, 6 tetrahedron, 9 hexahedron; corners of
 * quadrilaterals and hexahedra around their faces).
 */
template <int dim>
void write_mesh(Hdf5File &file, const Mesh<dim> &mesh);

/**
 * Reads a mesh of write_mesh(), with phase 0 and without boundaries. @p program wrote the
 * file; used in messages. @throws UserError
 */
template <int dim>
Mesh<dim> read_mesh_cells(const Hdf5File &file, const std::string &program);

/** Nodes and cells of a grid as a mesh, x fastest, with phase 0. */
template <int dim>
Mesh<dim> mesh_of_cells(const UniformGrid<dim> &grid);
} // namespace mesoslip

#endif
