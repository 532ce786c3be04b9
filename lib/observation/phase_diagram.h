#ifndef mesoslip_observation_phase_diagram_h
#define mesoslip_observation_phase_diagram_h

#include <vector>

namespace mesoslip
{
/** Mean limit cycle of one displacement component (the paper's figure 5(b)). */
struct PhaseDiagram
{
  /** Whole periods folded; 0: the signal has none and the arrays are empty. */
  unsigned int n_periods = 0;

  /**
   * Mean over the periods (m) in equal bins of the phase, which is 0 at the upward crossing
   * of the mean. The last bin is followed by the first one.
   */
  std::vector<double> displacement;
  std::vector<double> velocity;            ///< mean over the periods (m/s)
  std::vector<double> displacement_spread; ///< standard deviation among the periods (m)
  std::vector<double> velocity_spread;     ///< standard deviation among the periods (m/s)
};

/**
 * Folds displacement (m) and velocity (m/s), uniformly sampled every @p time_step seconds,
 * by phase, from one upward crossing of the mean displacement to the next, and averages
 * over the periods. Crossings closer than 0.6 of @p expected_period (s) are ignored, which
 * keeps harmonics from being taken for periods; 0: that of the main frequency of the
 * displacement.
 */
PhaseDiagram mean_phase_diagram(const std::vector<double> &displacement,
                                const std::vector<double> &velocity,
                                const double time_step,
                                const double expected_period = 0.);
} // namespace mesoslip

#endif
