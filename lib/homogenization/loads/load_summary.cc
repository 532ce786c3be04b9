#include "homogenization/loads/load_members.h"
#include "homogenization/loads/load_output.h"
#include "material/plausibility.h"
#include "program/run_context.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace mesoslip
{
using nlohmann::json;

namespace
{
template <int dim>
json by_component(const VoigtVector<dim> &vector)
{
  json object;
  for (int k = 0; k < n_voigt<dim>; ++k)
    object[voigt_names<dim>[static_cast<std::size_t>(k)]] = vector[k];
  return object;
}

/** The load as given in the .prm, and the components assumed to be zero. */
template <int dim>
json prescribed_json(const PrescribedLoad &load)
{
  json given = {{"strain", json::object()}, {"stress", json::object()}};
  for (std::size_t k = 0; k < load.strain.size(); ++k)
    {
      const std::string name = voigt_names<dim>[k];
      if (!std::isnan(load.strain[k]))
        given["strain"][name] = load.strain[k];
      if (!std::isnan(load.stress[k]))
        given["stress"][name] = load.stress[k];
    }
  given["stress_assumed_zero"] = load.assumed();
  given["temperature_change"]  = load.heating;
  return given;
}

template <int dim>
json place_json(const std::array<double, 3> &place)
{
  return std::vector<double>(place.begin(), place.begin() + dim);
}

template <int dim>
json part_json(const LoadResult<dim> &result,
               const std::size_t part,
               const LocalFields<dim> &fields)
{
  json object;
  for (std::size_t q = 0; q < fields.quantities().size(); ++q)
    {
      const Moments m = moments_in(result, part, q);
      if (!(m.volume > 0.))
        return nullptr;
      object[fields.quantities()[q].name] = {
        {"mean", m.mean},
        {"standard_deviation", m.standard_deviation()},
        {"minimum", m.minimum},
        {"maximum", m.maximum},
        {"minimum_at", place_json<dim>(m.minimum_at)},
        {"maximum_at", place_json<dim>(m.maximum_at)}};
    }
  return object;
}

/** Volume shares beyond the limits, by phase; null without a limit. */
template <int dim>
json beyond_json(const LoadParameters &loads,
                 const LoadResult<dim> &result,
                 const std::vector<std::string> &names)
{
  json object = {{"von_mises", nullptr}, {"principal_1", nullptr}};
  for (std::size_t p = 0; p < result.phases.size(); ++p)
    {
      if (!loads.von_mises_limit.empty())
        object["von_mises"][names[p]] = result.phases[p].beyond[0];
      if (!loads.principal_limit.empty())
        object["principal_1"][names[p]] = result.phases[p].beyond[1];
    }
  return object;
}

template <int dim>
json ensemble_of(const RveResults<dim> &results, const std::size_t k)
{
  json object;
  for (const bool of_strain : {true, false})
    {
      json &entry = object[of_strain ? "strain" : "stress"];
      for (int c = 0; c < n_voigt<dim>; ++c)
        {
          const auto [mean, deviation] =
            over_members(results.members.size(), [&](const std::size_t m) {
              const LoadResult<dim> &result = results.members[m].loads[k];
              return of_strain ? result.strain[c] : result.stress[c];
            });
          const std::string name = voigt_names<dim>[static_cast<std::size_t>(c)];
          entry["mean"][name]    = mean;
          entry["standard_deviation"][name] = deviation;
        }
    }
  return object;
}
} // namespace

template <int dim>
json loads_json(const RveParameters &parameters, const RveResults<dim> &results)
{
  json list                      = json::array();
  const auto fields              = fields_of<dim>(parameters);
  const auto parts               = parts_of(results);
  const LoadParameters &loads    = parameters.loads;
  const EnsembleMember<dim> &one = results.members[0];
  for (std::size_t k = 0; k < one.loads.size(); ++k)
    {
      const LoadResult<dim> &result = one.loads[k];
      json load                     = {
                            {"name", result.name},
                            {"condition", to_string(result.condition)},
                            {"prescribed", prescribed_json<dim>(loads.loads[k % loads.loads.size()])},
                            {"strain", by_component<dim>(result.strain)},
                            {"stress", by_component<dim>(result.stress)},
                            {"energy_density", result.energy},
                            {"mean_strain_residual", result.strain_residual},
                            {"mean_stress_residual", result.stress_residual},
                            {"hill_mandel_residual", result.hill_mandel_residual},
                            {"share_beyond_limit", beyond_json<dim>(loads, result, parts)}};
      for (std::size_t part = 0; part < parts.size(); ++part)
        load["phases"][parts[part]] = part_json<dim>(result, part, fields);
      if (results.members.size() > 1)
        load["ensemble"] = ensemble_of(results, k);
      list.push_back(load);
    }
  return list;
}

namespace
{
template <int dim>
std::string state_line(const std::string &what, const json &state, const double unit)
{
  std::ostringstream line;
  line << "  " << std::left << std::setw(34) << what << std::right
       << std::setprecision(4);
  double largest = 0.;
  for (const char *component : voigt_names<dim>)
    largest = std::max(largest, std::fabs(state[component].get<double>()));
  for (const char *component : voigt_names<dim>)
    {
      const double value = state[component].get<double>();
      // Round-off relative to the largest component is printed as 0.
      line << "  " << component << " " << std::setw(10)
           << (std::fabs(value) > 1e-12 * largest ? value / unit : 0.);
    }
  return line.str();
}

std::string heating_text(const json &prescribed)
{
  const double heating = prescribed.value("temperature_change", 0.);
  return heating == 0. ? std::string()
                       : brief_text(6, ", ", std::fabs(heating),
                                    heating > 0. ? " K warmer" : " K colder");
}

std::string phase_line(const std::string &phase, const json &quantities)
{
  std::ostringstream line;
  line << "  " << std::left << std::setw(34) << phase << std::right
       << std::setprecision(4);
  const auto add = [&](const char *name, const char *title) {
    if (quantities.contains(name))
      line << "  " << title << " mean " << std::setw(9)
           << quantities[name]["mean"].get<double>() * 1e-6 << " max " << std::setw(9)
           << quantities[name]["maximum"].get<double>() * 1e-6;
  };
  add("von_mises", "von Mises");
  add("principal_1", "sigma_1");
  if (!quantities.contains("von_mises"))
    for (const auto &[name, numbers] : quantities.items())
      if (name.rfind("stress_", 0) == 0)
        add(name.c_str(), name.c_str());
  return line.str();
}
} // namespace

template <int dim>
void log_loads(RunContext &context)
{
  const json loads = context.summary().value("loads", json::array());
  for (const json &load : loads)
    {
      const json &assumed = load["prescribed"]["stress_assumed_zero"];
      std::string zero;
      for (const json &component : assumed)
        zero += (zero.empty() ? "" : ", ") + component.get<std::string>();
      std::ostringstream line;
      line << "Load " << load["name"].get<std::string>() << ", "
           << load["condition"].get<std::string>() << heating_text(load["prescribed"])
           << (zero.empty() ? "" : "; not given, so taken as 0: stress " + zero)
           << std::scientific << std::setprecision(1) << "; residuals: mean strain "
           << load["mean_strain_residual"].get<double>() << ", mean stress "
           << load["mean_stress_residual"].get<double>() << ", Hill-Mandel "
           << load["hill_mandel_residual"].get<double>();
      context.log(line.str());
      context.log(state_line<dim>("macroscopic strain (1e-3)", load["strain"], 1e-3));
      context.log(state_line<dim>("macroscopic stress (MPa)", load["stress"], 1e6));
      for (const auto &[phase, quantities] : load["phases"].items())
        if (!quantities.is_null())
          context.log(phase_line(phase + " (MPa)", quantities));
    }
}

template json loads_json(const RveParameters &, const RveResults<2> &);
template json loads_json(const RveParameters &, const RveResults<3> &);
template void log_loads<2>(RunContext &);
template void log_loads<3>(RunContext &);
} // namespace mesoslip
