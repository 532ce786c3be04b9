#ifndef mesoslip_body_mesh_curved_mapping_h
#define mesoslip_body_mesh_curved_mapping_h

#include "mesh/mesh.h"

#include <deal.II/hp/mapping_collection.h>

#include <mpi.h>

namespace mesoslip
{
/** Mappings of quadrilaterals and hexahedra, and of simplices, for displacements of this @p degree: linear ones, or with the second degree and
 * curved cells quadratic ones. Only rank 0 has to have the mesh. Collective. */
template <int dim>
dealii::hp::MappingCollection<dim> mappings_of(const Mesh<dim> &mesh,
                                               const MPI_Comm communicator,
                                               const unsigned int degree);
} // namespace mesoslip

#endif
