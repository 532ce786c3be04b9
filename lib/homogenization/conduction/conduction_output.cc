#include "homogenization/conduction/conduction_output.h"

#include "homogenization/over_members.h"
#include "io/table.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <algorithm>
#include <iomanip>
#include <limits>
#include <sstream>

namespace mesoslip
{
namespace
{
using nlohmann::json;

template <int dim>
json matrix_json(const Tensor2<dim> &tensor)
{
  json rows = json::array();
  for (unsigned int i = 0; i < dim; ++i)
    rows.push_back(std::vector<double>(tensor.row(i).begin(), tensor.row(i).end()));
  return rows;
}

/** Smallest or largest conductivity of all phases. */
double extreme(const std::vector<PhaseParameters> &phases,
               const std::vector<double> &fractions,
               const bool largest)
{
  double found = largest ? 0. : std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < phases.size(); ++p)
    if (fractions[p] > 0.)
      for (const double k : phases[p].conductivities)
        found = largest ? std::max(found, k) : std::min(found, k);
  return found;
}
} // namespace

template <int dim>
std::map<std::string, Tensor2<dim>> conductivities(const RveParameters &parameters,
                                                   const RveResults<dim> &results)
{
  std::map<std::string, Tensor2<dim>> found;
  if (results.members[0].conduction.empty())
    return found;
  for (const ConductionResponse<dim> &response : results.members[0].conduction)
    found.emplace(to_string(response.condition), response.conductivity);
  Tensor2<dim> mean =
    mean_over(results.members, &EnsembleMember<dim>::conduction,
              &ConductionResponse<dim>::conductivity, effective_conditions(parameters));
  if (!parameters.effective_full)
    mean = Tensor2<dim>(mean.diagonal().asDiagonal());
  found["effective"] = mean;
  return found;
}

template <int dim>
std::map<std::string, std::array<double, 2>>
conductivity_bounds(const RveParameters &parameters, const std::vector<double> &fractions)
{
  std::map<std::string, std::array<double, 2>> bounds;
  const std::vector<PhaseParameters> &phases = parameters.microstructure.phases;
  for (const PhaseParameters &phase : phases)
    for (const double k : phase.conductivities)
      if (k != phase.conductivities[0])
        return bounds; // a phase is anisotropic
  double mean = 0., inverse = 0.;
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      mean += fractions[p] * phases[p].conductivities[0];
      inverse += fractions[p] / phases[p].conductivities[0];
    }
  bounds["wiener"] = {{1. / inverse, mean}};
  std::array<double, 2> both;
  for (const bool upper : {false, true})
    {
      const double G = (dim - 1.) * extreme(phases, fractions, upper);
      double sum     = 0.;
      for (std::size_t p = 0; p < phases.size(); ++p)
        sum += fractions[p] / (phases[p].conductivities[0] + G);
      both[upper ? 1 : 0] = 1. / sum - G;
    }
  bounds["hashin_shtrikman"] = both;
  return bounds;
}

template <int dim>
void write_conductivity(const RveResults<dim> &results, const RunContext &context)
{
  const auto &found = results.conductivity;
  if (found.empty())
    return;
  std::vector<std::string> headings = {"of"};
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      headings.push_back(std::string("k_") + "xyz"[i] + "xyz"[j]);
  TableWriter table(context.file("conductivity.csv"), headings);
  for (const auto &[of, k] : found)
    {
      std::vector<std::string> row = {of};
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i; j < dim; ++j)
          row.push_back(to_text(k(i, j)));
      table.add_row(row);
    }
  table.flush();
}

template <int dim>
void summarize_conductivity(const RveParameters &parameters,
                            const RveResults<dim> &results,
                            json &summary)
{
  for (const auto &[of, k] : results.conductivity)
    summary["conductivity"][of] = matrix_json<dim>(k);
  const EnsembleMember<dim> &first = results.members[0];
  if (first.conduction.empty())
    return;
  for (const auto &[name, both] : conductivity_bounds<dim>(parameters, first.fractions))
    summary["conductivity_bounds"][name] = both;
  for (const ConductionResponse<dim> &response : first.conduction)
    {
      const std::string name                   = to_string(response.condition);
      summary["conductivity_residual"][name]   = response.residual;
      summary["conductivity_iterations"][name] = response.iterations;
    }
}

void log_conductivity(RunContext &context)
{
  const json found = context.summary().value("conductivity", json());
  if (found.is_null())
    return;
  std::ostringstream line;
  line << "Effective conductivity (in the unit of the phases)" << std::setprecision(5);
  const json &k = found["effective"];
  for (std::size_t i = 0; i < k.size(); ++i)
    for (std::size_t j = i; j < k.size(); ++j)
      if (i == j || k[i][j].get<double>() != 0.)
        line << "  "
             << "xyz"[i] << "xyz"[j] << " " << k[i][j].get<double>();
  context.log(line.str());
}

template <int dim>
std::vector<std::string>
conductivity_warnings(const RveParameters &parameters,
                      const std::vector<EnsembleMember<dim>> &members)
{
  return residual_warnings(
    members, &EnsembleMember<dim>::conduction, &ConductionResponse<dim>::residual,
    "the conductivities from the energy and from the mean flux", parameters.tolerance);
}

#define MESOSLIP_INSTANTIATE(dim)                                                     \
  template std::map<std::string, Tensor2<dim>> conductivities<dim>(                   \
    const RveParameters &, const RveResults<dim> &);                                  \
  template std::map<std::string, std::array<double, 2>> conductivity_bounds<dim>(     \
    const RveParameters &, const std::vector<double> &);                              \
  template void write_conductivity<dim>(const RveResults<dim> &, const RunContext &); \
  template void summarize_conductivity<dim>(const RveParameters &,                    \
                                            const RveResults<dim> &, json &);         \
  template std::vector<std::string> conductivity_warnings<dim>(                       \
    const RveParameters &, const std::vector<EnsembleMember<dim>> &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
