#ifndef mesoslip_homogenization_conduction_conduction_output_h
#define mesoslip_homogenization_conduction_conduction_output_h

#include "homogenization/rve_program.h"
#include "io/json.h"

#include <array>
#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
/** Conductivity of the first member by condition, and "effective": the mean over all
 * members and effective_conditions(). Empty if it was not asked for. */
template <int dim>
std::map<std::string, Tensor2<dim>> conductivities(const RveParameters &parameters,
                                                   const RveResults<dim> &results);

/** Lower and upper bounds by name: "wiener" (Reuss and Voigt) and, for isotropic phases
 * in an isotropic morphology, "hashin_shtrikman". Empty if a phase is not isotropic. */
template <int dim>
std::map<std::string, std::array<double, 2>>
conductivity_bounds(const RveParameters &parameters,
                    const std::vector<double> &fractions);

/** Writes conductivity.csv, if it was asked for. */
template <int dim>
void write_conductivity(const RveResults<dim> &results, const RunContext &context);

/** Adds conductivities, bounds, residuals and iterations to summary.json. */
template <int dim>
void summarize_conductivity(const RveParameters &parameters,
                            const RveResults<dim> &results,
                            nlohmann::json &summary);

/** Prints the effective conductivity of a summary, new or restored, on the console. */
void log_conductivity(RunContext &context);

/** Warnings if the conductivities from energy and from means disagree.
 * @throws NumericalFailure if fewer than two digits agree */
template <int dim>
std::vector<std::string>
conductivity_warnings(const RveParameters &parameters,
                      const std::vector<EnsembleMember<dim>> &members);
} // namespace mesoslip

#endif
