#include "homogenization/derivatives/derivative_output.h"

#include "homogenization/derivatives/loss_output.h"
#include "io/table.h"
#include "material/engineering_constants.h"
#include "parameters/parameters.h"
#include "program/run_context.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mesoslip
{
namespace
{
using nlohmann::json;

/** The constants that are smooth functions of the stiffness: all except distances and
 * angles. */
template <int dim>
std::vector<EngineeringConstant> smooth_constants(const VoigtMatrix<dim> &D)
{
  std::vector<EngineeringConstant> constants = engineering_constants<dim>(D);
  const auto is_smooth                       = [](const EngineeringConstant &constant) {
    return constant.unit != "rad" && constant.name != "anisotropy" &&
           constant.name != "non_orthotropy";
  };
  constants.erase(std::stable_partition(constants.begin(), constants.end(), is_smooth),
                  constants.end());
  return constants;
}

/** Derivatives of smooth_constants() along a change of the stiffness: a central
 * difference of fourth order, with a step of 1e-3 of the stiffness. */
template <int dim>
std::vector<double> derivatives_of_constants(const VoigtMatrix<dim> &D,
                                             const VoigtMatrix<dim> &change)
{
  std::vector<double> result(smooth_constants<dim>(D).size(), 0.);
  // Scaled by the diagonal, as moduli may differ by many orders of magnitude.
  double size = 0.;
  for (unsigned int i = 0; i < n_voigt<dim>; ++i)
    for (unsigned int j = 0; j < n_voigt<dim>; ++j)
      size = std::max(size, std::fabs(change(i, j)) / std::sqrt(D(i, i) * D(j, j)));
  if (size == 0.)
    return result;
  const double step = 1e-3 / size;
  for (const auto &[at, weight] :
       {std::pair(1., 8.), std::pair(-1., -8.), std::pair(2., -1.), std::pair(-2., 1.)})
    {
      const auto constants = smooth_constants<dim>(D + at * step * change);
      for (std::size_t k = 0; k < result.size(); ++k)
        result[k] += weight * constants[k].value / (12. * step);
    }
  return result;
}

/** Mean derivative along variation @p v over all members and @p conditions. */
template <int dim>
VoigtMatrix<dim> mean_derivative(const std::vector<EnsembleMember<dim>> &members,
                                 const std::vector<BoundaryCondition> &conditions,
                                 const std::size_t v)
{
  VoigtMatrix<dim> sum = VoigtMatrix<dim>::Zero();
  double n             = 0.;
  for (const EnsembleMember<dim> &member : members)
    for (const HomogenizedResponse<dim> &response : member.responses)
      if (std::count(conditions.begin(), conditions.end(), response.condition) > 0)
        {
          sum += response.derivatives[v];
          n += 1.;
        }
  return sum / n;
}

template <int dim>
VoigtMatrix<dim> effective_derivative(const RveParameters &parameters,
                                      const RveResults<dim> &results,
                                      const std::size_t v)
{
  const VoigtMatrix<dim> D =
    mean_derivative<dim>(results.members, effective_conditions(parameters), v);
  return parameters.effective_full ? D : orthotropic_part<dim>(D);
}

template <int dim>
std::vector<Variation<dim>> variations_in(const RveParameters &parameters)
{
  return variations_of<dim>(parameters.microstructure.phases, parameters.derivatives);
}

/** Standard deviation of a result whose constants are independent, to first order. */
template <int dim>
double deviation_of(const VariedResult &result,
                    const std::vector<Variation<dim>> &variations)
{
  double squares = 0.;
  for (std::size_t v = 0; v < variations.size(); ++v)
    squares += std::pow(result.derivatives[v] * variations[v].constant.deviation, 2);
  return std::sqrt(squares);
}

template <int dim>
bool has_deviations(const std::vector<Variation<dim>> &variations)
{
  return std::any_of(
    variations.begin(), variations.end(),
    [](const Variation<dim> &variation) { return variation.constant.deviation > 0.; });
}

template <int dim>
void write_uncertainty(const std::vector<VariedResult> &varied,
                       const std::vector<Variation<dim>> &variations,
                       const std::string &path)
{
  std::vector<std::string> headings = {"result", "value", "unit", "standard_deviation",
                                       "relative_deviation [-]"};
  for (const Variation<dim> &variation : variations)
    if (!is_loss(variation))
      headings.push_back("variance_from_" + variation.phase + "_" +
                         variation.constant.name + " [-]");
  TableWriter table(path, headings);
  for (const VariedResult &result : varied)
    {
      const double deviation       = deviation_of(result, variations);
      std::vector<std::string> row = {
        result.name, to_text(result.value), result.unit, to_text(deviation),
        result.value != 0. ? to_text(deviation / std::fabs(result.value)) : ""};
      for (std::size_t v = 0; v < variations.size(); ++v)
        if (!is_loss(variations[v]))
          {
            const double part = result.derivatives[v] * variations[v].constant.deviation;
            row.push_back(to_text(deviation > 0. ? std::pow(part / deviation, 2) : 0.));
          }
      table.add_row(row);
    }
  table.flush();
}

} // namespace

template <int dim>
std::vector<VariedResult> varied_results(const RveParameters &parameters,
                                         const RveResults<dim> &results,
                                         const std::vector<Variation<dim>> &variations)
{
  std::vector<VariedResult> varied;
  for (const auto &[i, j, name] : stiffness_entries<dim>())
    varied.push_back({name, "Pa", results.effective(i, j), {}});
  for (const EngineeringConstant &c : smooth_constants<dim>(results.effective))
    varied.push_back({c.name, c.unit, c.value, {}});
  for (std::size_t v = 0; v < variations.size(); ++v)
    {
      const VoigtMatrix<dim> change = effective_derivative<dim>(parameters, results, v);
      auto next                     = varied.begin();
      for (const StiffnessEntry &entry : stiffness_entries<dim>())
        (next++)->derivatives.push_back(change(entry.row, entry.column));
      for (const double one : derivatives_of_constants<dim>(results.effective, change))
        (next++)->derivatives.push_back(one);
    }
  return varied;
}

template <int dim>
std::vector<VariedConstant<dim>> varied_constants(const RveParameters &parameters,
                                                  const RveResults<dim> &results)
{
  const auto &phases    = parameters.microstructure.phases;
  const auto variations = variations_in<dim>(parameters);
  std::vector<VariedConstant<dim>> constants;
  for (std::size_t v = 0; v < variations.size() && !is_loss(variations[v]); ++v)
    {
      const auto of = std::find_if(phases.begin(), phases.end(), [&](const auto &phase) {
        return phase.name == variations[v].phase;
      });
      const auto phase                = static_cast<std::size_t>(of - phases.begin());
      const PhaseConstant<dim> &given = variations[v].constant;
      VariedConstant<dim> &constant   = constants.emplace_back();
      constant = {phase, given.name, given.value, given.deviation, given.derivative, {}};
      for (const BoundaryCondition condition : parameters.conditions)
        constant.of_volume[to_string(condition)] =
          mean_derivative<dim>({results.members[0]}, {condition}, v);
      constant.of_volume["effective"] = effective_derivative<dim>(parameters, results, v);
    }
  return constants;
}

template <int dim>
void write_derivatives(const RveParameters &parameters,
                       const RveResults<dim> &results,
                       const RunContext &context)
{
  const auto variations = variations_in<dim>(parameters);
  if (variations.empty())
    return;
  const auto varied = varied_results<dim>(parameters, results, variations);
  if (is_loss(variations.back()))
    write_loss(lossy_results<dim>(parameters, results, varied),
               context.file("loss_factors.csv"));
  if (has_deviations(variations))
    write_uncertainty(varied, variations, context.file("uncertainty.csv"));
  if (is_loss(variations.front()))
    return;
  std::vector<std::string> headings = {"of", "phase", "constant", "value", "unit"};
  for (const StiffnessEntry &entry : stiffness_entries<dim>())
    headings.push_back("d" + entry.name + " [Pa/unit]");
  TableWriter table(context.file("derivatives.csv"), headings);
  const auto add_row = [&](const std::string &of, const Variation<dim> &variation,
                           const VoigtMatrix<dim> &D) {
    const PhaseConstant<dim> &constant = variation.constant;
    std::vector<std::string> row       = {of, variation.phase, constant.name,
                                          to_text(constant.value), constant.unit};
    for (const StiffnessEntry &entry : stiffness_entries<dim>())
      row.push_back(to_text(D(entry.row, entry.column)));
    table.add_row(row);
  };
  for (std::size_t v = 0; v < variations.size() && !is_loss(variations[v]); ++v)
    {
      for (const BoundaryCondition condition : parameters.conditions)
        add_row(to_string(condition), variations[v],
                mean_derivative<dim>(results.members, {condition}, v));
      add_row("effective", variations[v],
              effective_derivative<dim>(parameters, results, v));
    }
  table.flush();
}

template <int dim>
void summarize_derivatives(const RveParameters &parameters,
                           const RveResults<dim> &results,
                           json &summary)
{
  const auto variations = variations_in<dim>(parameters);
  if (variations.empty())
    return;
  const auto varied      = varied_results<dim>(parameters, results, variations);
  const bool is_deviated = has_deviations(variations);
  for (const VariedResult &result : varied)
    {
      json &out      = summary["varied"][result.name];
      out["value"]   = result.value;
      out["unit"]    = result.unit;
      double largest = 0.;
      std::string why;
      for (std::size_t v = 0; v < variations.size(); ++v)
        {
          const PhaseConstant<dim> &constant = variations[v].constant;
          if (!is_loss(variations[v]))
            out["derivatives"][variations[v].phase][constant.name] =
              result.derivatives[v];
          const double part = std::fabs(result.derivatives[v] * constant.deviation);
          if (part > largest)
            {
              largest = part;
              why     = variations[v].phase + " " + constant.name;
            }
        }
      if (!is_deviated)
        continue;
      out["standard_deviation"]   = deviation_of(result, variations);
      out["largest_contribution"] = why;
    }
  if (is_loss(variations.back()))
    for (const auto &[name, unit, value] :
         lossy_results<dim>(parameters, results, varied))
      {
        summary["varied"][name]["real"]      = value.real();
        summary["varied"][name]["imaginary"] = value.imag();
      }
}

void log_derivatives(RunContext &context)
{
  const json varied = context.summary().value("varied", json::object());
  for (const auto &[name, result] : varied.items())
    {
      // The console shows moduli and Poisson's ratios only.
      const bool is_modulus = name[0] == 'E' || name[0] == 'G', is_ratio = name[0] == 'n';
      if (!(is_modulus || is_ratio) || name.find("iso") != std::string::npos)
        continue;
      std::ostringstream line;
      line.precision(5);
      const double value = result["value"], unit = is_modulus ? 1e-9 : 1.;
      line << name << " = " << unit * value << (is_modulus ? " GPa" : "");
      line.precision(3);
      if (result.contains("standard_deviation"))
        {
          const double deviation = result["standard_deviation"];
          line << ", standard deviation " << unit * deviation << " ("
               << 100. * deviation / std::fabs(value) << " %, most of it from "
               << result["largest_contribution"].get<std::string>() << ")";
        }
      if (is_modulus && result.contains("imaginary"))
        line << ", loss factor "
             << result["imaginary"].get<double>() / result["real"].get<double>();
      if (result.contains("standard_deviation") ||
          (is_modulus && result.contains("imaginary")))
        context.log(line.str());
    }
}

#define MESOSLIP_INSTANTIATE(dim)                                                      \
  template std::vector<VariedResult> varied_results<dim>(                              \
    const RveParameters &, const RveResults<dim> &,                                    \
    const std::vector<Variation<dim>> &);                                              \
  template std::vector<VariedConstant<dim>> varied_constants<dim>(                     \
    const RveParameters &, const RveResults<dim> &);                                   \
  template void write_derivatives<dim>(const RveParameters &, const RveResults<dim> &, \
                                       const RunContext &);                            \
  template void summarize_derivatives<dim>(const RveParameters &,                      \
                                           const RveResults<dim> &, json &);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
