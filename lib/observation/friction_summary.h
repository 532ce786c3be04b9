#ifndef mesoslip_observation_friction_summary_h
#define mesoslip_observation_friction_summary_h

#include <string>
#include <vector>

namespace mesoslip
{
/** A value and how far it may be trusted, by batch means. */
struct Estimate
{
  double value = 0.; ///< the mean

  /** Standard deviation among the batches; 0 with fewer than two of them. */
  double batch_deviation = 0.;

  /** batch_deviation / sqrt(batches) */
  double standard_error = 0.;

  /** Half width of the 95 % confidence interval (Student); 0 with fewer than two batches.
   */
  double half_width = 0.;

  /** Batches of whole periods; at most 20, so that neighbours are hardly correlated. */
  unsigned int batches = 0;

  /** s; the value rests on the samples from here to #end. */
  double begin = 0.;
  double end   = 0.; ///< s; the last sample used
};

/**
 * Global interface friction coefficient, eq. (9): least-squares slope of the frictional
 * energy (J, per m of thickness in 2D) over @p from <= time <= @p to, divided by
 * @p reference_power = P S |V| (W). The window is shortened at its beginning to whole
 * periods, all of which count; a @p period of 0 leaves it as it is. The error follows
 * from the mean powers of batches (end differences, exact for a limit cycle) of
 * ceil(periods / 20) periods each, counted backwards from the end; without a period of
 * ten equal parts. Periods at the beginning that do not fill a batch count for the value
 * only.
 *
 * @throws UserError if fewer than three samples lie in the window or the reference power
 * is not positive
 */
Estimate interface_friction_coefficient(const std::vector<double> &time,
                                        const std::vector<double> &friction_energy,
                                        double from,
                                        double to,
                                        double period,
                                        double reference_power);

/**
 * Mean of uniformly sampled @p values over whole periods of the same window, for instance
 * of the apparent friction coefficient mu_app(t) (paper, remark 1). @throws UserError as
 * above
 */
Estimate window_mean(const std::vector<double> &time,
                     const std::vector<double> &values,
                     double from,
                     double to,
                     double period);

/** Shares of time of a node (or of all); they sum to 1. */
struct ContactShares
{
  double slip       = 0.; ///< touching and sliding
  double stick      = 0.; ///< touching without sliding
  double separation = 0.; ///< not touching
};

/**
 * Name of the instability type (paper, section 2.4; Linck et al. 2003) from the shares of
 * the reference node. A state that takes less than @p threshold of the time does not
 * count:
 *
 *     slip                          permanent slip
 *     stick                         permanent stick
 *     separation                    permanent separation
 *     slip + stick                  stick-slip
 *     slip + separation             slip-separation, regime 1 (mostly slipping)    slip
 * >= separation slip-separation, regime 2 (mostly separated)   slip <  separation stick +
 * separation            stick-separation all three stick-slip-separation
 *
 * @throws std::invalid_argument if the shares are negative or do not sum to 1 within 1e-6
 */
std::string regime_label(const ContactShares &shares, double threshold = 0.01);
} // namespace mesoslip

#endif
