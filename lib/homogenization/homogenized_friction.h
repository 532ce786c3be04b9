#ifndef mesoslip_homogenization_homogenized_friction_h
#define mesoslip_homogenization_homogenized_friction_h

#include <vector>

namespace mesoslip
{
/**
 * Mean friction coefficient over a contact duration, eqs. (11-13),
 *
 *     mu_bar = mu [1 + delta / T_G (exp(-T_G / delta) - 1)],
 *
 * with the limits mu (delta = 0) and mu T_G / (2 delta) (delta >> T_G); accurate to
 * round-off in between.
 *
 * @param friction_coefficient local Coulomb coefficient mu, > 0
 * @param regularization_time delta, s, >= 0
 * @param contact_duration T_G, s, > 0
 * @throws UserError outside these ranges
 */
double mean_friction_coefficient(double friction_coefficient,
                                 double regularization_time,
                                 double contact_duration);

/**
 * Regularization time that yields a mean friction coefficient: the inverse of
 * mean_friction_coefficient(), s. This adapts the homogeneous model to the heterogeneous
 * one (paper, section 3.6).
 *
 * @throws UserError unless 0 < mean_coefficient < friction_coefficient and
 *   contact_duration > 0
 */
double regularization_time_for(double mean_coefficient,
                               double friction_coefficient,
                               double contact_duration);

/** Contact properties of a phase. */
struct ContactPhase
{
  /** Area S_i in m^2, m per m of thickness, or as a fraction: only ratios matter. */
  double area = 0.;

  /** Young's modulus E_i, Pa; used by the static pressure repartition only. */
  double youngs_modulus = 0.;

  /** Coulomb coefficient mu_i. */
  double friction_coefficient = 0.;
};

/**
 * Contact pressures P_i of the phases under the static pressure repartition (SPR: equal
 * strain), eqs. (18, 19): P_i = E_i P S / sum_j S_j E_j, in the unit of @p pressure.
 * @throws UserError unless areas and moduli are positive
 */
std::vector<double> static_pressure_repartition(double pressure,
                                                const std::vector<ContactPhase> &phases);

/**
 * mu_homo of eq. (17) for given contact pressures of the phases, for instance of a static
 * contact analysis (SCA): sum_i mu_i P_i S_i / (P S).
 *
 * @param phases  areas S_i and coefficients mu_i
 * @param phase_pressures  P_i, one a phase, in the unit of @p pressure
 * @param pressure  applied pressure P; 0: the area average of the phase pressures
 * @throws UserError on lengths that differ, areas or a mean pressure that are not
 * positive
 */
double homogenized_friction_coefficient(const std::vector<ContactPhase> &phases,
                                        const std::vector<double> &phase_pressures,
                                        double pressure = 0.);

/** mu_homo under SPR, eqs. (20, 21): sum_i S_i mu_i E_i / sum_i S_i E_i. */
double homogenized_friction_coefficient(const std::vector<ContactPhase> &phases);
} // namespace mesoslip

#endif
