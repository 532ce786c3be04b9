#ifndef mesoslip_observation_spectrum_h
#define mesoslip_observation_spectrum_h

#include <limits>
#include <optional>
#include <vector>

namespace mesoslip
{
/** One-sided amplitude spectrum: a sine of amplitude A shows as a peak of height A. */
struct Spectrum
{
  /** Hz, uniform from 0 to the Nyquist frequency. */
  std::vector<double> frequency;

  /** In the unit of the signal; as long as #frequency. */
  std::vector<double> amplitude;
};

/** A local maximum of a spectrum, interpolated between the bins. */
struct SpectralPeak
{
  /** Hz */
  double frequency = 0.;

  /** In the unit of the signal. */
  double amplitude = 0.;
};

/** Where the main frequency is looked for; both in Hz. */
struct FrequencyBand
{
  double from = 1e3;                                     ///< lower end
  double to   = std::numeric_limits<double>::infinity(); ///< upper end
};

/** What a figure like the paper's 5(c) says. */
struct SpectralSummary
{
  /** Highest peak in the band. */
  SpectralPeak main;

  /**
   * The other peaks of the band that rise above the threshold (10 % of the main one),
   * by increasing frequency: harmonics, and what else vibrates.
   */
  std::vector<SpectralPeak> harmonics;

  /** Hz; highest frequency whose amplitude exceeds the threshold (paper, section 3.2). */
  double highest_frequency = 0.;
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

/** Share of the power above zero frequency that is in the highest tenth of the band; what
 * is beyond the band is folded into it. 0 without a signal. */
double share_near_limit(const Spectrum &spectrum);

/**
 * Main peak (parabola through the logarithms of the three highest bins), other peaks and
 * highest significant frequency within @p band. Nothing if the band holds no peak, as for
 * a constant signal.
 *
 * @param spectrum  of amplitude_spectrum()
 * @param band  Hz; peaks outside are not seen
 * @param threshold  fraction of the main amplitude below which nothing counts
 * @param noise_floor  amplitude below which the signal counts as constant, in its unit
 */
std::optional<SpectralSummary>
summarize_spectrum(const Spectrum &spectrum,
                   const FrequencyBand &band = FrequencyBand(),
                   double threshold          = 0.1,
                   double noise_floor        = 0.);
} // namespace mesoslip

#endif
