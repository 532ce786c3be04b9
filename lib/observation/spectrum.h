#ifndef mesoslip_observation_spectrum_h
#define mesoslip_observation_spectrum_h

#include <optional>
#include <vector>

namespace mesoslip
{
/** One-sided amplitude spectrum: a sine of amplitude A gives a peak of height A. */
struct Spectrum
{
  /** Hz, uniform from 0 to the Nyquist frequency. */
  std::vector<double> frequency;

  /** In the unit of the signal; same length as #frequency. */
  std::vector<double> amplitude;

  double duration = 0.; ///< duration of the signal without padding zeros (s)

  /** Frequency (Hz) with two periods in the signal; slower motion may be a drift. */
  double lowest_frequency() const
  {
    return duration > 0. ? 2. / duration : 0.;
  }
};

/** Key numbers of a spectrum like the paper's figure 5(c), for frequencies from
 * Spectrum::lowest_frequency() on. */
struct SpectralSummary
{
  double main_frequency = 0.; ///< at the highest peak (Hz)
  double main_amplitude = 0.; ///< at the highest peak, in the unit of the signal

  /** Highest frequency with more than 10 % of the main amplitude (Hz; paper, sect. 3.2).
   */
  double highest_frequency = 0.;

  double slow_amplitude = 0.; ///< largest amplitude below Spectrum::lowest_frequency()
};

/**
 * Amplitude spectrum of @p signal, sampled every @p time_step seconds. Mean and linear
 * trend are removed, a Hann window applied and its gain corrected; zeros are appended to
 * the next power of two of @p padding times the length, so that peaks interpolate well.
 * Fewer than 8 samples give an empty spectrum.
 *
 * @throws std::invalid_argument for a time step that is not positive
 * @throws NumericalFailure if the signal is not finite
 */
Spectrum amplitude_spectrum(const std::vector<double> &signal,
                            double time_step,
                            unsigned int padding = 4);

/**
 * Share of the power above zero frequency in the highest tenth of the frequencies, into
 * which faster motion is aliased. 0 without a signal.
 */
double share_near_limit(const Spectrum &spectrum);

/**
 * Main peak (parabola through the logarithms of the three highest bins) and highest
 * significant frequency of a spectrum of amplitude_spectrum(). Empty if there is no peak
 * above @p noise_floor (in the unit of the signal), as for a constant signal.
 */
std::optional<SpectralSummary> summarize_spectrum(const Spectrum &spectrum,
                                                  const double noise_floor = 0.);

/** Mean limit cycle of one displacement component (the paper's figure 5(b)). */
struct PhaseDiagram
{
  /** Number of folded periods; 0: the signal has none and the arrays are empty. */
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
 * Folds displacement (m) and velocity (m/s), uniformly sampled every @p time_step
 * seconds, by phase, from one upward crossing of the mean displacement to the next, and
 * averages over the periods. Crossings closer than 0.6 of @p expected_period (s) are
 * ignored, so that harmonics are not taken for periods; 0: the period of the main
 * frequency of the displacement.
 */
PhaseDiagram mean_phase_diagram(const std::vector<double> &displacement,
                                const std::vector<double> &velocity,
                                const double time_step,
                                const double expected_period = 0.);
} // namespace mesoslip

#endif
