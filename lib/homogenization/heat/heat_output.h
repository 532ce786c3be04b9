#ifndef mesoslip_homogenization_heat_heat_output_h
#define mesoslip_homogenization_heat_heat_output_h

#include "homogenization/rve_program.h"
#include "io/json.h"

#include <map>
#include <string>
#include <vector>

namespace mesoslip
{
/** Thermal expansion (1/K, engineering shear) of the first member by condition, and
 * "effective": D^-1 of the mean thermal stress over effective_conditions(), with the
 * effective stiffness D. Empty if no phase expands. */
template <int dim>
std::map<std::string, VoigtVector<dim>> expansions(const RveParameters &parameters,
                                                   const RveResults<dim> &results);

/** Writes expansion.csv, if a phase expands. */
template <int dim>
void write_expansion(const RveResults<dim> &results, const RunContext &context);

/** Adds the expansion to summary.json. */
template <int dim>
void summarize_expansion(const RveResults<dim> &results, nlohmann::json &summary);

/** Prints the effective expansion of a summary, new or restored, on the console. */
void log_expansion(RunContext &context);

/** Warnings if a solved case and reciprocity disagree.
 * @throws NumericalFailure if fewer than two digits agree */
template <int dim>
std::vector<std::string>
expansion_warnings(const RveParameters &parameters,
                   const std::vector<EnsembleMember<dim>> &members);
} // namespace mesoslip

#endif
