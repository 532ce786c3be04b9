#ifndef mesoslip_exchange_mesh_datasets_h
#define mesoslip_exchange_mesh_datasets_h

#include "grid/uniform_grid.h"
#include "io/hdf5_file.h"
#include "mesh/mesh.h"

#include <string>

namespace mesoslip
{
/** Number of integers of write_mesh()'s topology. */
template <int dim>
std::size_t topology_size(const Mesh<dim> &mesh);

/**
 * The corners and cells of @p mesh in the HDF5 file: /mesh/points [n][dim] in m, and
 * /mesh/topology, for each cell its kind and corners as XDMF's mixed topology has them
 * (kinds 4 triangle, 5 quadrilateral, 6 tetrahedron, 9 hexahedron; corners of
 * quadrilaterals and hexahedra around their faces).
 */
template <int dim>
void write_mesh(Hdf5File &file, const Mesh<dim> &mesh);

/**
 * What write_mesh() has written, of phase 0 everywhere and without boundaries.
 * @p program wrote the file, for messages. @throws UserError
 */
template <int dim>
Mesh<dim> read_mesh_cells(const Hdf5File &file, const std::string &program);

/** The nodes and cells of a grid as those of a mesh, x fastest, of phase 0. */
template <int dim>
Mesh<dim> mesh_of_cells(const UniformGrid<dim> &grid);
} // namespace mesoslip

#endif
