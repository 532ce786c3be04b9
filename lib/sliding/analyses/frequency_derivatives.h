#ifndef mesoslip_sliding_analyses_frequency_derivatives_h
#define mesoslip_sliding_analyses_frequency_derivatives_h

#include "sliding/analyses/modal_cases.h"
#include "sliding/given_body.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** A constant of a phase and the changes of the stiffness of a body with it. */
template <int dim>
struct BodyVariation
{
  std::string name;      ///< phase and constant, such as matrix_E
  double deviation = 0.; ///< standard deviation, in the unit of the constant

  /** Derivative of the stiffness of each phase of the body (Pa / unit). */
  std::vector<VoigtMatrix<dim>> changes;
};

/** Constants with a Relative deviation of the phases of a body on the flat: of its RVE
 * file or of the groups of its mesh. Empty for pairs of bodies. On rank 0.
 * @throws UserError */
template <int dim>
std::vector<BodyVariation<dim>> body_variations(const GivenBody<dim> &body);

/**
 * Derivatives of the frequency of @p mode with respect to the stiffness of each phase
 * (Hz/Pa): a change dC of a phase changes the frequency by the scalar product of its
 * matrix and dC. From Rayleigh's quotient, strain_products() / (8 pi^2 f modal mass),
 * exact for the cells of the body and frequencies without a twin. Collective.
 */
template <int dim>
std::vector<VoigtMatrix<dim>> frequency_derivatives(const ElasticBody<dim> &body,
                                                    const VibrationMode<dim> &mode);

/**
 * Writes frequency_derivatives.csv if Modal/Derivatives is set, and, if constants have
 * deviations, frequency_uncertainty.csv, the standard deviations in summary.json and in
 * the log. Collective.
 */
template <int dim>
void write_frequency_derivatives(const GivenBody<dim> &body,
                                 const std::vector<ModalCase<dim>> &cases,
                                 RunContext &context);
} // namespace mesoslip

#endif
