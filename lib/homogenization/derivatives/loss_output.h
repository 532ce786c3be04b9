#ifndef mesoslip_homogenization_derivatives_loss_output_h
#define mesoslip_homogenization_derivatives_loss_output_h

#include "homogenization/derivatives/derivative_output.h"

#include <complex>
#include <string>
#include <vector>

namespace mesoslip
{
/** A complex number that follows from the effective stiffness, and its unit. */
struct ComplexResult
{
  std::string name;           ///< of VariedResult
  std::string unit;           ///< "Pa" or "1"
  std::complex<double> value; ///< in that unit
};

/** The results that lose energy: entries, Young's and shear moduli of the complex stiffness, or all @p varied ones to
 * first order in the loss factors. */
template <int dim>
std::vector<ComplexResult> lossy_results(const RveParameters &parameters,
                                         const RveResults<dim> &results,
                                         const std::vector<VariedResult> &varied);

/** Writes loss_factors.csv, of which @p path is the name. */
void write_loss(const std::vector<ComplexResult> &lossy, const std::string &path);

/** Sentences on how far loss factors can be trusted. */
template <int dim>
std::vector<std::string> loss_warnings(const RveParameters &parameters,
                                       const std::vector<EnsembleMember<dim>> &members);
} // namespace mesoslip

#endif
