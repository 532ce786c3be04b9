#ifndef mesoslip_observation_phase_diagram_h
#define mesoslip_observation_phase_diagram_h

#include <vector>

namespace mesoslip
{
/** Mean limit cycle of one displacement component (the paper's figure 5(b)). */
struct PhaseDiagram
{
  /** s; mean period, and its standard deviation from cycle to cycle. */
  double period           = 0.;
  double period_deviation = 0.; ///< from cycle to cycle

  /** Whole periods folded; 0: the signal has none and the arrays are empty. */
  unsigned int n_periods = 0;

  /** Centres of the bins in (0, 1), phase 0 at the upward crossing of the mean. */
  std::vector<double> phase;

  /** m and m/s; mean over the periods. The last bin is followed by the first one. */
  std::vector<double> displacement;
  std::vector<double> velocity; ///< mean (m/s)

  /** m and m/s; standard deviation from period to period in each bin. */
  std::vector<double> displacement_spread;
  std::vector<double> velocity_spread; ///< m/s
};

/**
 * Times, in units of samples, at which @p signal crosses @p level upwards (linear
 * interpolation). A crossing counts only after the signal has been below level -
 * hysteresis, and only the first one within @p minimum_distance samples.
 */
std::vector<double> upward_crossings(const std::vector<double> &signal,
                                     double level,
                                     double hysteresis       = 0.,
                                     double minimum_distance = 0.);

/**
 * Fold displacement and velocity (uniformly sampled every @p time_step) by phase, from
 * one upward crossing of the mean displacement to the next, and average over the periods.
 *
 * @param displacement  m, one value a sample
 * @param velocity  m/s, at the same times
 * @param time_step  s, from sample to sample
 * @param bins  of the phase
 * @param expected_period  s; keeps harmonics from being taken for periods: crossings
 *   closer than 0.6 of it are ignored. 0: from the main frequency of the displacement
 * @throws std::invalid_argument if the lengths differ or the time step is not positive
 */
PhaseDiagram mean_phase_diagram(const std::vector<double> &displacement,
                                const std::vector<double> &velocity,
                                double time_step,
                                double expected_period = 0.,
                                unsigned int bins      = 200);
} // namespace mesoslip

#endif
