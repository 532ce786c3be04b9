#ifndef mesoslip_tests_verification_divided_body_h
#define mesoslip_tests_verification_divided_body_h

#include "body/mesh/mesh_body.h"
#include "eigenvalues/free_dofs.h"

#include <deal.II/base/mpi.h>

#include <memory>

namespace verification
{
/** With fields that are divided among the ranks; rank 0 alone hands the mesh over. */
inline std::unique_ptr<mesoslip::MeshBody<3>>
divided(const mesoslip::MeshBodyInput<3> &input)
{
  mesoslip::MeshBodyInput<3> rest = input;
  rest.mesh                       = {};
  const bool is_root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  return mesoslip::MeshBody<3>::divide(is_root ? input.mesh : mesoslip::Mesh<3>(), rest,
                                       MPI_COMM_WORLD);
}

/** All components of the nodes of the top. */
inline mesoslip::DofMask held_at_top(const mesoslip::ElasticBody<3> &body)
{
  mesoslip::DofMask held(body.n_columns(), 1);
  for (const mesoslip::NodeIndex &node :
       body.surface(mesoslip::ElasticBody<3>::top).nodes)
    for (unsigned int c = 0; c < 3; ++c)
      held.constrain(c, node);
  return held;
}

/** A platen of this mass on the top, which moves along its normal. */
inline mesoslip::Platen platen_on_top(const mesoslip::ElasticBody<3> &body,
                                      const double mass)
{
  return {
    body.surface(mesoslip::ElasticBody<3>::top).nodes, {{false, false, true}}, mass};
}
} // namespace verification

#endif
