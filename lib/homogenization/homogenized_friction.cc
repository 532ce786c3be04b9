#include "homogenization/homogenized_friction.h"

#include "base/errors.h"
#include "base/text.h"

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

namespace mesoslip
{
namespace
{
/** (1 - exp(-x)) / x */
double lost_share(const double x)
{
  return x > 0. ? -std::expm1(-x) / x : 1.;
}

/** 1 - (1 - exp(-x)) / x without cancellation: x/2! - x^2/3! + x^3/4! - ... */
double kept_share(const double x)
{
  if (x > 0.5)
    return 1. - lost_share(x);
  double term = 0.5 * x, sum = 0.;
  for (unsigned int k = 3; std::abs(term) > 1e-18 * sum; ++k)
    {
      sum += term;
      term *= -x / k;
    }
  return sum;
}

void require(const bool holds,
             const std::string &what,
             const double found,
             const std::string &expected)
{
  std::ostringstream text;
  text << "homogenized friction: the " << what << " is " << found << ", but has to be "
       << expected;
  if (!holds)
    throw UserError(text.str());
}

void require_positive(const std::string &what, const double found)
{
  require(found > 0. && std::isfinite(found), what, found, "positive");
}

void check_phases(const std::vector<ContactPhase> &phases, const bool with_modulus)
{
  require(!phases.empty(), "number of phases in contact", 0., "one at least");
  for (const ContactPhase &phase : phases)
    {
      require_positive("contact area of a phase", phase.area);
      if (with_modulus)
        require_positive("Young's modulus of a phase in Pa", phase.youngs_modulus);
      require(phase.friction_coefficient >= 0., "friction coefficient of a phase",
              phase.friction_coefficient, "zero or positive");
    }
}

double total_area(const std::vector<ContactPhase> &phases)
{
  double area = 0.;
  for (const ContactPhase &phase : phases)
    area += phase.area;
  return area;
}
} // namespace

double mean_friction_coefficient(const double friction_coefficient,
                                 const double regularization_time,
                                 const double contact_duration)
{
  require_positive("friction coefficient mu", friction_coefficient);
  require(regularization_time >= 0. && std::isfinite(regularization_time),
          "regularization time in s", regularization_time, "zero or positive");
  require_positive("contact duration T_G in s", contact_duration);
  if (regularization_time == 0.)
    return friction_coefficient;
  return friction_coefficient * kept_share(contact_duration / regularization_time);
}

double regularization_time_for(const double mean_coefficient,
                               const double friction_coefficient,
                               const double contact_duration)
{
  require_positive("friction coefficient mu", friction_coefficient);
  require_positive("contact duration T_G in s", contact_duration);
  require(mean_coefficient > 0. && mean_coefficient < friction_coefficient,
          "mean friction coefficient", mean_coefficient,
          "between 0 and mu = " + to_text(friction_coefficient) +
            " (both excluded) for a regularization time to exist");
  // x = T_G / delta. Uses the share (lost or kept) that has no cancellation; 2 kept <= x
  // <= 1 / lost brackets the root.
  const double kept   = mean_coefficient / friction_coefficient;
  const double lost   = (friction_coefficient - mean_coefficient) / friction_coefficient;
  const auto residual = [kept, lost](const double x) {
    return kept < 0.5 ? kept_share(x) / kept - 1. : 1. - lost_share(x) / lost;
  };
  const double lower = 2. * kept * (1. - 1e-12), upper = (1. + 1e-12) / lost;
  std::uintmax_t iterations = 200;
  const auto root           = boost::math::tools::toms748_solve(
              residual, lower, upper, boost::math::tools::eps_tolerance<double>(50), iterations);
  return contact_duration / (0.5 * (root.first + root.second));
}

std::vector<double> static_pressure_repartition(const double pressure,
                                                const std::vector<ContactPhase> &phases)
{
  check_phases(phases, true);
  double stiffness = 0.;
  for (const ContactPhase &phase : phases)
    stiffness += phase.area * phase.youngs_modulus;
  const double strain = pressure * total_area(phases) / stiffness;
  std::vector<double> pressures;
  for (const ContactPhase &phase : phases)
    pressures.push_back(phase.youngs_modulus * strain);
  return pressures;
}

double homogenized_friction_coefficient(const std::vector<ContactPhase> &phases,
                                        const std::vector<double> &phase_pressures,
                                        const double pressure)
{
  check_phases(phases, false);
  require(phase_pressures.size() == phases.size(), "number of phase pressures",
          static_cast<double>(phase_pressures.size()),
          "the number of phases in contact, " + std::to_string(phases.size()));
  double friction = 0., force = 0.;
  for (std::size_t i = 0; i < phases.size(); ++i)
    {
      force += phases[i].area * phase_pressures[i];
      friction += phases[i].friction_coefficient * phases[i].area * phase_pressures[i];
    }
  const double mean = pressure != 0. ? pressure : force / total_area(phases);
  require(mean > 0. && std::isfinite(friction), "mean contact pressure in Pa", mean,
          "positive (pressing)");
  return friction / (mean * total_area(phases));
}

double homogenized_friction_coefficient(const std::vector<ContactPhase> &phases)
{
  return homogenized_friction_coefficient(phases, static_pressure_repartition(1., phases),
                                          1.);
}
} // namespace mesoslip
