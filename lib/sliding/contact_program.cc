#include "sliding/contact_program.h"

#include "grid/instruction_set.h"
#include "sliding/analyses/friction_homogenization.h"
#include "sliding/analyses/modal.h"
#include "sliding/analyses/static_contact.h"
#include "sliding/complex/complex_analysis.h"
#include "sliding/sweep/sweep_analysis.h"
#include "sliding/transient/transient.h"

namespace mesoslip
{
namespace
{
/** The analysis @p A of the body that the parameters give. */
template <template <int> class A, typename... More>
std::unique_ptr<Analysis> of_body(const ContactParameters &parameters,
                                  const More &...more)
{
  if (parameters.mesh.mesh.dim == 2)
    return std::make_unique<A<2>>(make_given_body<2>(parameters), more...);
  return std::make_unique<A<3>>(make_given_body<3>(parameters), more...);
}

std::unique_ptr<Analysis> build(Keys &keys)
{
  resolve(InstructionSet::automatic); // reports an invalid MESOSLIP_ISA
  ContactParameters parameters;
  parameters.bind(keys);
  SweepParameters sweep;
  sweep.bind(keys);
  keys.require(!sweep.is_given() || parameters.analysis == ContactAnalysis::transient,
               "Analysis",
               "maps (Sweep/Axes) are of transient runs; set Analysis = transient, and "
               "Sweep/Complex modes = true for the complex modes of each point");
  if (sweep.is_given())
    return std::make_unique<SweepAnalysis>(sweep, keys, contact_dynamics_program());
  switch (parameters.analysis)
    {
    case ContactAnalysis::modal:
      return of_body<ModalAnalysis>(parameters);
    case ContactAnalysis::static_contact:
      return of_body<StaticContactAnalysis>(parameters);
    case ContactAnalysis::complex_modes:
      return of_body<ComplexModesAnalysis>(parameters);
    case ContactAnalysis::friction_homogenization:
      return std::make_unique<FrictionHomogenizationAnalysis>(parameters);
    default:
      return of_body<TransientAnalysis>(parameters, keys);
    }
}
} // namespace

Application contact_dynamics_program()
{
  return {"contact_dynamics",
          "Explicit dynamics of an elastic body that rubs on a moving rigid flat.",
          [](Keys &keys) {
            ContactParameters().bind(keys);
            SweepParameters().bind(keys);
          },
          build, "a dynamics.h5 without displacements (transient, static contact)"};
}
} // namespace mesoslip
