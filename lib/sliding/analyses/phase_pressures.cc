#include "sliding/analyses/phase_pressures.h"

#include "base/text.h"
#include "io/json.h"
#include "material/engineering_constants.h"
#include "material/plausibility.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace mesoslip
{
namespace
{
/**
 * Contact phases with @p fractions as areas, Young's moduli of the closest isotropic
 * solids, and friction coefficients. Absent phases are left out.
 */
template <int dim>
std::vector<ContactPhase> contact_phases(const std::vector<Phase<dim>> &phases,
                                         const std::vector<double> &fractions)
{
  std::vector<ContactPhase> result;
  for (std::size_t p = 0; p < phases.size(); ++p)
    if (fractions[p] > 0.)
      {
        const double E = closest_isotropic<dim>(phases[p].stiffness).young_modulus;
        result.push_back({fractions[p], E, phases[p].friction_coefficient});
      }
  return result;
}
} // namespace

template <int dim>
PhasePressures phase_pressures(const ContactParameters &parameters,
                               const std::vector<Phase<dim>> &phases,
                               const std::vector<double> &surface_fraction,
                               const std::vector<double> &sum,
                               const double mean_pressure)
{
  PhasePressures result;
  result.surface_fraction              = surface_fraction;
  std::vector<ContactPhase> in_contact = contact_phases<dim>(phases, surface_fraction);
  // Springs and sides carry a part of the pressure on the top, and tractions add to it.
  const TopSetup &top                   = parameters.top;
  const std::vector<double> repartition = static_pressure_repartition(
    parameters.sides_carry_normally() || top.suspension.stiffness[dim - 1] > 0. ||
        top.suspension.traction.acts(dim - 1)
      ? mean_pressure
      : top.pressure.amplitude(),
    in_contact);
  std::vector<double> pressures;
  for (std::size_t p = 0; p < phases.size(); ++p)
    {
      result.names.push_back(phases[p].name);
      result.pressure.emplace_back();
      result.repartition.emplace_back();
      if (const double f = surface_fraction[p]; f > 0.)
        {
          result.repartition.back() = repartition[pressures.size()];
          result.pressure.back()    = pressures.emplace_back(sum[p] / f);
        }
    }
  const double total = std::accumulate(sum.begin(), sum.end(), 0.);
  result.imbalance   = std::fabs(total - mean_pressure) / std::fabs(mean_pressure);

  if (!parameters.friction.coefficient_by_phase)
    for (ContactPhase &phase : in_contact)
      phase.friction_coefficient = parameters.friction.coefficient;
  result.mu_homo             = homogenized_friction_coefficient(in_contact, pressures);
  result.mu_homo_repartition = homogenized_friction_coefficient(in_contact);
  return result;
}

std::vector<std::string> pressure_lines(const PhasePressures &found,
                                        const std::optional<double> sliding)
{
  std::vector<std::string> lines;
  for (std::size_t p = 0; p < found.names.size(); ++p)
    lines.push_back(
      "  " + found.names[p] + " " +
      (found.pressure[p]
         ? quantity_text(100. * found.surface_fraction[p], "%") +
             " of the contact, mean pressure " +
             quantity_text(1e-6 * *found.pressure[p], "MPa") +
             " (eq. 19: " + quantity_text(1e-6 * *found.repartition[p], "MPa") + ")"
         : "not in contact"));
  lines.push_back(brief_text(
    4, "Homogenized friction coefficient, eq. (17): ", found.mu_homo,
    " with these pressures, ", found.mu_homo_repartition, " with those of eq. (19)",
    sliding ? "; tangential over normal force, by the coefficients of the nodes: " +
                quantity_text(*sliding, "")
            : ""));
  return lines;
}

void add_pressures(const PhasePressures &found, nlohmann::json &json)
{
  json["phase_pressure_imbalance"]         = found.imbalance;
  json["homogenized_friction_coefficient"] = {{"static_contact", found.mu_homo},
                                              {"eq_19", found.mu_homo_repartition}};
  for (std::size_t p = 0; p < found.names.size(); ++p)
    {
      json["surface_fractions"][found.names[p]]       = found.surface_fraction[p];
      json["phase_contact_pressures"][found.names[p]] = found.pressure[p];
      json["phase_pressures_eq_19"][found.names[p]]   = found.repartition[p];
    }
}

#define MESOSLIP_INSTANTIATE(dim)                               \
  template PhasePressures phase_pressures<dim>(                 \
    const ContactParameters &, const std::vector<Phase<dim>> &, \
    const std::vector<double> &, const std::vector<double> &, const double);
MESOSLIP_INSTANTIATE(2)
MESOSLIP_INSTANTIATE(3)
#undef MESOSLIP_INSTANTIATE
} // namespace mesoslip
