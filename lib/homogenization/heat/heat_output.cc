#include "homogenization/heat/heat_output.h"

#include "homogenization/over_members.h"
#include "io/table.h"
#include "material/engineering_constants.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace mesoslip
{
namespace
{
using nlohmann::json;

/** Thermal stress (Pa/K) of a response. */
template <int dim>
VoigtVector<dim> thermal_stress(const HomogenizedResponse<dim> &response)
{
  return response.heat.stress;
}

template <int dim>
json list_of(const VoigtVector<dim> &vector)
{
  return std::vector<double>(vector.begin(), vector.end());
}
} // namespace

template <int dim>
std::map<std::string, VoigtVector<dim>> expansions(const RveParameters &parameters,
                                                   const RveResults<dim> &results)
{
  std::map<std::string, VoigtVector<dim>> found;
  const std::vector<EnsembleMember<dim>> &members = results.members;
  if (!members[0].responses[0].heat.exists)
    return found;
  for (const HomogenizedResponse<dim> &response : members[0].responses)
    found[to_string(response.condition)] = response.heat.expansion;
  VoigtVector<dim> stress =
    mean_over(members, &EnsembleMember<dim>::responses, &thermal_stress<dim>,
              effective_conditions(parameters));
  if (!parameters.effective_full)
    stress.template tail<n_voigt<dim> - dim>().setZero();
  found["effective"] = inverse<dim>(results.effective) * stress;
  return found;
}

template <int dim>
void write_expansion(const RveResults<dim> &results, const RunContext &context)
{
  const auto &found = results.expansion;
  if (found.empty())
    return;
  const EnsembleMember<dim> &first  = results.members[0];
  std::vector<std::string> headings = {"of"};
  for (const char *name : voigt_names<dim>)
    headings.push_back(std::string("expansion_") + name + " [1/K]");
  for (const char *name : voigt_names<dim>)
    headings.push_back(std::string("thermal_stress_") + name + " [Pa/K]");
  TableWriter table(context.file("expansion.csv"), headings);
  for (const auto &[name, expansion] : found)
    {
      const std::string &of = name;
      const auto response   = std::find_if(first.responses.begin(), first.responses.end(),
                                           [&of](const HomogenizedResponse<dim> &one) {
                                           return to_string(one.condition) == of;
                                         });
      const VoigtMatrix<dim> &D =
        response == first.responses.end() ? results.effective : response->stiffness;
      std::vector<std::string> row = {of};
      for (const double value : expansion)
        row.push_back(to_text(value));
      for (const double value : VoigtVector<dim>(D * expansion))
        row.push_back(to_text(value));
      table.add_row(row);
    }
  table.flush();
}

template <int dim>
void summarize_expansion(const RveResults<dim> &results, json &summary)
{
  for (const auto &[of, expansion] : results.expansion)
    summary["expansion"][of] = list_of<dim>(expansion);
  for (const HomogenizedResponse<dim> &response : results.members[0].responses)
    if (response.heat.exists)
      {
        summary["thermal_stress"][to_string(response.condition)] =
          list_of<dim>(response.heat.stress);
        summary["expansion_residual"][to_string(response.condition)] =
          response.heat.residual;
      }
}

void log_expansion(RunContext &context)
{
  const json found = context.summary().value("expansion", json());
  if (found.is_null())
    return;
  const std::vector<double> effective = found["effective"];
  std::ostringstream line;
  line << "Effective expansion (1e-6/K)" << std::setprecision(5);
  for (std::size_t k = 0; k < effective.size(); ++k)
    line << "  "
         << (effective.size() == n_voigt<2> ? voigt_names<2>[k] : voigt_names<3>[k])
         << " " << 1e6 * effective[k];
  context.log(line.str());
}

template <int dim>
std::vector<std::string>
expansion_warnings(const RveParameters &parameters,
                   const std::vector<EnsembleMember<dim>> &members)
{
  return residual_warnings(
    members, &EnsembleMember<dim>::responses,
    [](const HomogenizedResponse<dim> &response) { return response.heat.residual; },
    "the thermal stress of the unit load cases and the one of the case of heat",
    parameters.tolerance);
}

#define MESOSLIP_INSTANTIATE(dim)                                                  \
  template std::map<std::string, VoigtVector<dim>> expansions<dim>(                \
    const RveParameters &, const RveResults<dim> &);                               \
  template void write_expansion<dim>(const RveResults<dim> &, const RunContext &); \
  template void summarize_expansion<dim>(const RveResults<dim> &, json &);         \
  template std::vector<std::string> expansion_warnings<dim>(                       \
    const RveParameters &, const std::vector<EnsembleMember<dim>> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
