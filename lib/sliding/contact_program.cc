#include "sliding/contact_program.h"

#include "grid/instruction_set.h"
#include "sliding/analyses/friction_homogenization.h"
#include "sliding/analyses/modal.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/complex/grid_complex.h"
#include "sliding/mesh/mesh_modal.h"
#include "sliding/mesh/mesh_transient.h"
#include "sliding/mesh/statics/mesh_static.h"
#include "sliding/transient/transient.h"

namespace mesoslip
{
namespace
{
std::unique_ptr<Analysis> build(Keys &keys)
{
  resolve(InstructionSet::automatic); // tells what is wrong with MESOSLIP_ISA
  ContactParameters parameters;
  parameters.bind(keys);
  switch (parameters.analysis)
    {
    case ContactAnalysis::modal:
      if (!parameters.mesh.is_plane_grid())
        return make_mesh_modal(parameters);
      return std::make_unique<ModalAnalysis>(parameters);
    case ContactAnalysis::static_contact:
      if (!parameters.mesh.is_plane_grid())
        return make_mesh_static(parameters);
      return std::make_unique<StaticContactAnalysis>(parameters);
    case ContactAnalysis::complex_modes:
      if (!parameters.mesh.is_plane_grid())
        return make_mesh_complex(parameters);
      return std::make_unique<ComplexModesAnalysis>(parameters);
    case ContactAnalysis::friction_homogenization:
      return std::make_unique<FrictionHomogenizationAnalysis>(parameters);
    default:
      if (!parameters.mesh.is_plane_grid())
        return make_mesh_transient(parameters, keys);
      return std::make_unique<TransientAnalysis>(parameters, keys);
    }
}
} // namespace

Application contact_dynamics_program()
{
  return {"contact_dynamics",
          "Explicit dynamics of an elastic body that rubs on a moving rigid flat.",
          [](Keys &keys) { ContactParameters().bind(keys); }, build,
          "a dynamics.h5 without displacements (transient, static contact)"};
}
} // namespace mesoslip
