#ifndef mesoslip_homogenization_derivatives_variations_h
#define mesoslip_homogenization_derivatives_variations_h

#include "homogenization/response.h"
#include "homogenization/volumes/volume_element.h"
#include "morphology/phases/phase_parameters.h"

#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** A change of the stiffness of phases. */
template <int dim>
struct Variation
{
  std::string phase;           ///< name; empty: the loss factors of all phases
  PhaseConstant<dim> constant; ///< the constant; for the loss only its name is set

  /** Change of the stiffness of each phase (Pa over the unit of the constant). */
  std::vector<VoigtMatrix<dim>> stiffness;
};

/** Variations of each constant of each of the @p phases, if they are @p wanted or a phase
 * has deviations. The variation with the loss factors, if there are any, comes last. */
template <int dim>
std::vector<Variation<dim>> variations_of(const std::vector<PhaseParameters> &phases,
                                          const bool wanted);

/** Whether @p variation is the variation with the loss factors. */
template <int dim>
bool is_loss(const Variation<dim> &variation)
{
  return variation.phase.empty();
}

/** Nonzero changes of a material: number of the variation and stiffness (Pa over the unit
 * of the constant). */
template <int dim>
using StiffnessChanges = std::vector<std::pair<std::size_t, VoigtMatrix<dim>>>;

/**
 * Derivatives of the effective stiffness (Pa) along @p n_variations changes of the
 * material stiffness. KUBC, PBC and MUBC: dD = mean of A^T dC A. SUBC: dS = -mean of A^T
 * dC A and dD = -D dS D. A are the strains of the unit load cases that were solved last.
 * The derivative is exact for the cells of the volume, because the load cases make the
 * energy stationary. @p changes is indexed by material. Collective.
 */
template <int dim>
std::vector<VoigtMatrix<dim>>
stiffness_derivatives(const VolumeElement<dim> &volume,
                      const HomogenizedResponse<dim> &response,
                      const std::vector<StiffnessChanges<dim>> &changes,
                      const std::size_t n_variations);
} // namespace mesoslip

#endif
