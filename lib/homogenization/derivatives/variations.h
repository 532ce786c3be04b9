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
  std::string phase;           ///< name; empty: all of them lose energy
  PhaseConstant<dim> constant; ///< what changes; of the loss its name alone

  /** Stiffness (Pa over the unit of the constant) of each phase. */
  std::vector<VoigtMatrix<dim>> stiffness;
};

/** Those with each constant of each of the @p phases, if they are @p wanted or a phase has deviations, and, last,
 * with the loss factors if there are any. */
template <int dim>
std::vector<Variation<dim>> variations_of(const std::vector<PhaseParameters> &phases,
                                          const bool wanted);

/** Whether @p variation is the one with the loss factors. */
template <int dim>
bool is_loss(const Variation<dim> &variation)
{
  return variation.phase.empty();
}

/** The changes of a material that are not zero: number of the variation and stiffness (Pa over the unit of the constant). */
template <int dim>
using StiffnessChanges = std::vector<std::pair<std::size_t, VoigtMatrix<dim>>>;

/**
 * Derivatives of the effective stiffness (Pa) along @p n_variations changes of the stiffness of the materials of the
 * volume: of KUBC, PBC and MUBC dD = mean of A^T dC A, of SUBC dS = -mean of A^T dC A and dD = -D dS D, with the
 * strains A of the unit load cases that were solved last. Exact for the cells of the volume: the load cases make
 * the energy stationary. @p changes are those of each material. Collective.
 */
template <int dim>
std::vector<VoigtMatrix<dim>>
stiffness_derivatives(const VolumeElement<dim> &volume,
                      const HomogenizedResponse<dim> &response,
                      const std::vector<StiffnessChanges<dim>> &changes,
                      const std::size_t n_variations);
} // namespace mesoslip

#endif
