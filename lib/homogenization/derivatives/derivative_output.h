#ifndef mesoslip_homogenization_derivatives_derivative_output_h
#define mesoslip_homogenization_derivatives_derivative_output_h

#include "homogenization/derivatives/variations.h"
#include "homogenization/rve_program.h"
#include "io/json.h"

#include <vector>

namespace mesoslip
{
/** A number derived from the effective stiffness, with its derivatives along
 * variations. */
struct VariedResult
{
  std::string name; ///< D11 or a name of engineering_constants()
  std::string unit; ///< "Pa", or "1" for pure numbers
  double value;     ///< in that unit

  /** Derivative along each variation. */
  std::vector<double> derivatives;
};

/** The entries of the effective stiffness and the engineering constants that are smooth
 * functions of it, with their derivatives along @p variations; averaged over members and
 * conditions like the stiffness. */
template <int dim>
std::vector<VariedResult> varied_results(const RveParameters &parameters,
                                         const RveResults<dim> &results,
                                         const std::vector<Variation<dim>> &variations);

/** Constants of the phases with the derivatives of their stiffness, and of the stiffness
 * of the volume: by condition for the first member, "effective" for all. */
template <int dim>
std::vector<VariedConstant<dim>> varied_constants(const RveParameters &parameters,
                                                  const RveResults<dim> &results);

/** Writes derivatives.csv, uncertainty.csv and loss_factors.csv, each if it has
 * content. */
template <int dim>
void write_derivatives(const RveParameters &parameters,
                       const RveResults<dim> &results,
                       const RunContext &context);

/** Adds the derivatives, deviations and loss factors of the effective stiffness to
 * summary.json. */
template <int dim>
void summarize_derivatives(const RveParameters &parameters,
                           const RveResults<dim> &results,
                           nlohmann::json &summary);

/** Prints deviations and loss factors of a summary, new or restored, on the console. */
void log_derivatives(RunContext &context);
} // namespace mesoslip

#endif
