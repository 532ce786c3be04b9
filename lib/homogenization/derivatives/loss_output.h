#ifndef mesoslip_homogenization_derivatives_loss_output_h
#define mesoslip_homogenization_derivatives_loss_output_h

#include "homogenization/derivatives/derivative_output.h"

#include <complex>
#include <string>
#include <vector>

namespace mesoslip
{
/** A complex number derived from the effective stiffness, and its unit. */
struct ComplexResult
{
  std::string name;           ///< such as D11 or E_x
  std::string unit;           ///< "Pa" or "1"
  std::complex<double> value; ///< in that unit
};

/** The lossy results: entries, Young's and shear moduli of the complex stiffness, or all
 * @p varied results to first order in the loss factors. */
template <int dim>
std::vector<ComplexResult> lossy_results(const RveParameters &parameters,
                                         const RveResults<dim> &results,
                                         const std::vector<VariedResult> &varied);

/** Writes loss_factors.csv at @p path. */
void write_loss(const std::vector<ComplexResult> &lossy, const std::string &path);

/** Warnings on the reliability of loss factors. */
template <int dim>
std::vector<std::string> loss_warnings(const RveParameters &parameters,
                                       const std::vector<EnsembleMember<dim>> &members);
} // namespace mesoslip

#endif
