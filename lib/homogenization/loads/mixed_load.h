#ifndef mesoslip_homogenization_loads_mixed_load_h
#define mesoslip_homogenization_loads_mixed_load_h

#include "homogenization/loads/load_parameters.h"
#include "material/voigt.h"

namespace mesoslip
{
/** Macroscopic strain E and stress S = D E - beta T at a temperature change T. */
template <int dim>
struct MacroscopicState
{
  VoigtVector<dim> strain = VoigtVector<dim>::Zero(); ///< engineering shear
  VoigtVector<dim> stress = VoigtVector<dim>::Zero(); ///< Pa
};

/** Factors of the unit load cases: macroscopic strains (SUBC: stresses) in Voigt order,
 * then the change of temperature (K). */
template <int dim>
using LoadAmplitudes = Eigen::Matrix<double, n_voigt<dim> + 1, 1>;

/**
 * The state under @p load of a volume with the @p stiffness D (Pa) and the
 * @p thermal_stress beta (Pa/K). Strain is given for the components P, stress for the
 * components Q: D_QQ E_Q = S_Q + beta_Q T - D_QP E_P, and S_P = D_PP E_P + D_PQ E_Q -
 * beta_P T.
 */
template <int dim>
MacroscopicState<dim> solve_mixed_load(const VoigtMatrix<dim> &stiffness,
                                       const VoigtVector<dim> &thermal_stress,
                                       const PrescribedLoad &load);
} // namespace mesoslip

#endif
