#ifndef mesoslip_homogenization_loads_mixed_load_h
#define mesoslip_homogenization_loads_mixed_load_h

#include "homogenization/loads/load_parameters.h"
#include "material/voigt.h"

namespace mesoslip
{
/** Macroscopic strain E and stress S = D E. */
template <int dim>
struct MacroscopicState
{
  VoigtVector<dim> strain = VoigtVector<dim>::Zero(); ///< engineering shear
  VoigtVector<dim> stress = VoigtVector<dim>::Zero(); ///< Pa
};

/**
 * The state under @p load of a volume with the @p stiffness D (Pa). With the components P of
 * which the strain is given and Q of which the stress is,
 * D_QQ E_Q = S_Q - D_QP E_P, and S_P = D_PP E_P + D_PQ E_Q.
 */
template <int dim>
MacroscopicState<dim> solve_mixed_load(const VoigtMatrix<dim> &stiffness,
                                       const PrescribedLoad &load);
} // namespace mesoslip

#endif
