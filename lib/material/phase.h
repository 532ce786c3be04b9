#ifndef mesoslip_material_phase_h
#define mesoslip_material_phase_h

#include "material/voigt.h"

#include <string>

namespace mesoslip
{
/** One constituent of the composite. */
template <int dim>
struct Phase
{
  std::string name; ///< unique among the phases

  /** Pa; plane strain in 2D. */
  VoigtMatrix<dim> stiffness = VoigtMatrix<dim>::Zero();

  /** kg/m^3 */
  double density = 0.;

  /** Coulomb coefficient of contact nodes that lie in this phase. */
  double friction_coefficient = 0.;
};
} // namespace mesoslip

#endif
