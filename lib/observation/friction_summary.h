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

/** Part of the time over which means are taken. */
struct MeanWindow
{
  double from   = 0.; ///< s
  double to     = 0.; ///< s
  double period = 0.; ///< s; 0: none
};

/**
 * Mean power (W) of a work (J) that is known since the start: its least-squares slope in
 * @p window. The window is shortened at its beginning to whole periods, all of which
 * count; without a period it is left as it is. The error follows from the mean powers of
 * batches (end differences, exact for a limit cycle) of ceil(periods / 20) periods each,
 * counted backwards from the end; without a period of ten equal parts. Periods at the
 * beginning that do not fill a batch count for the value only.
 *
 * @throws UserError if fewer than three samples lie in the window
 */
Estimate mean_power(const std::vector<double> &time,
                    const std::vector<double> &work,
                    const MeanWindow &window);

/**
 * Global interface friction coefficient, eq. (9): mean power of the frictional energy
 * over that of the work @p load_work of the load along the way of the flat (P S |V| t
 * while all of them are constant). Its error is that of a ratio of means.
 *
 * @throws UserError as above, or if the mean power of the load is not positive
 */
Estimate interface_friction_coefficient(const std::vector<double> &time,
                                        const std::vector<double> &friction_energy,
                                        const std::vector<double> &load_work,
                                        const MeanWindow &window);

/**
 * Mean of uniformly sampled @p values over whole periods of the same window, for instance
 * of the apparent friction coefficient mu_app(t) (paper, remark 1). @throws UserError as
 * above
 */
Estimate window_mean(const std::vector<double> &time,
                     const std::vector<double> &values,
                     const MeanWindow &window);

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
 *     slip + separation             slip-separation, regime 1 (mostly slipping) if
 *                                   slip >= separation, else regime 2 (mostly separated)
 *     stick + separation            stick-separation
 *     all three                     stick-slip-separation
 *
 * @throws std::invalid_argument if the shares are negative or do not sum to 1 within 1e-6
 */
std::string regime_label(const ContactShares &shares, double threshold = 0.01);
} // namespace mesoslip

#endif
