#ifndef mesoslip_body_mesh_curved_mapping_h
#define mesoslip_body_mesh_curved_mapping_h

#include "mesh/mesh.h"

#include <deal.II/hp/mapping_collection.h>

#include <mpi.h>

namespace mesoslip
{
/**
 * Mappings of quadrilaterals and hexahedra, and of simplices, for displacements of this
 * @p degree: quadratic if @p degree is 2 and cells are curved, else linear. Only rank 0
 * needs the mesh. Collective.
 */
template <int dim>
dealii::hp::MappingCollection<dim> mappings_of(const Mesh<dim> &mesh,
                                               const MPI_Comm communicator,
                                               const unsigned int degree);
} // namespace mesoslip

#endif
