#ifndef mesoslip_observation_friction_summary_h
#define mesoslip_observation_friction_summary_h

#include <vector>

namespace mesoslip
{
/** A mean over a window of time and how far it may be trusted, by batch means. */
struct Estimate
{
  double value = 0.; ///< the mean

  /** Half width of the 95 % confidence interval (Student); 0 with fewer than two batches.
   */
  double half_width = 0.;

  /** Batches of whole periods; at most 20, so that neighbours are hardly correlated. */
  unsigned int batches = 0;

  double begin = 0.; ///< first time that counts (s)
  double end   = 0.; ///< last time that counts (s)
};

/** Part of the time over which means are taken: to the last sample. */
struct MeanWindow
{
  double from   = 0.; ///< s; three samples at least are not before it
  double period = 0.; ///< s; 0: none
};

/**
 * Mean power (W) of a work (J) that is known since the start: its least-squares slope in
 * @p window. The window is shortened at its beginning to whole periods, all of which
 * count; without a period it is left as it is. The error follows from the mean powers of
 * batches (end differences, exact for a limit cycle) of ceil(periods / 20) periods each,
 * counted backwards from the end; without a period of ten equal parts. Periods at the
 * beginning that do not fill a batch count for the value only.
 */
Estimate mean_power(const std::vector<double> &time,
                    const std::vector<double> &work,
                    const MeanWindow &window);

/**
 * Global interface friction coefficient, eq. (9): mean power of the frictional energy
 * over that of the work @p load_work of the load along the way of the flat (P S |V| t
 * while all of them are constant), which must be positive. Its error is that of a ratio
 * of means.
 */
Estimate interface_friction_coefficient(const std::vector<double> &time,
                                        const std::vector<double> &friction_energy,
                                        const std::vector<double> &load_work,
                                        const MeanWindow &window);

/**
 * Mean of uniformly sampled @p values over whole periods of the same window, for instance
 * of the apparent friction coefficient mu_app(t) (paper, remark 1).
 */
Estimate window_mean(const std::vector<double> &time,
                     const std::vector<double> &values,
                     const MeanWindow &window);
} // namespace mesoslip

#endif
