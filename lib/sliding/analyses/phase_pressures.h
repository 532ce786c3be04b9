#ifndef mesoslip_sliding_analyses_phase_pressures_h
#define mesoslip_sliding_analyses_phase_pressures_h

#include "homogenization/homogenized_friction.h"
#include "sliding/contact_parameters.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace mesoslip
{
/** Contact pressures of the phases in a static contact and the resulting coefficients of
 * friction; by phase, empty for phases without contact. */
struct PhasePressures
{
  std::vector<std::string> names;                 ///< phase names
  std::vector<double> surface_fraction;           ///< share of the contact
  std::vector<std::optional<double>> pressure;    ///< mean (Pa)
  std::vector<std::optional<double>> repartition; ///< by eq. (19) (Pa)

  /** Relative difference between the force of these pressures and the force on the
   * flat. */
  double imbalance = 0.;

  double mu_homo             = 0.; ///< eq. (17) with the phases' pressures
  double mu_homo_repartition = 0.; ///< eq. (17) with the pressures of eq. (19)
};

/**
 * @p sum: integral of the pressure over each phase's part of the contact, divided by the
 * area of the whole contact (Pa). @p mean_pressure: on the flat (Pa).
 */
template <int dim>
PhasePressures phase_pressures(const ContactParameters &parameters,
                               const std::vector<Phase<dim>> &phases,
                               const std::vector<double> &surface_fraction,
                               const std::vector<double> &sum,
                               const double mean_pressure);

/** Lines for the log; @p sliding is the tangential over the normal force of a sliding body.
 */
std::vector<std::string> pressure_lines(const PhasePressures &found,
                                        const std::optional<double> sliding);

/** Adds the pressures to summary.json. */
void add_pressures(const PhasePressures &found, nlohmann::json &json);
} // namespace mesoslip

#endif
