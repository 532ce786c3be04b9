#ifndef mesoslip_eigenvalues_complex_mode_count_h
#define mesoslip_eigenvalues_complex_mode_count_h

#include "eigenvalues/complex/disc_search.h"

namespace mesoslip
{
/** What is counted, as a SearchRange has it. */
struct CountedRange
{
  double low   = 0.; ///< lowest circular frequency (1/s)
  double top   = 0.; ///< highest circular frequency (1/s)
  double decay = 0.; ///< largest decay rate (1/s)
  double right = 0.; ///< largest growth rate (1/s)
  double steep = 1.; ///< largest decay rate over the circular frequency

  /** Whether @p s lies inside. */
  bool contains(const SlidingPencil::Complex s) const
  {
    return s.imag() > low && s.imag() < top && s.real() < right &&
           s.real() > -std::min(decay, steep * s.imag());
  }
};

/** The middle of the widest gap between @p from, @p to and those @p values that lie between. */
double widest_gap(const double from, const double to, std::vector<double> values);

/** The pencil without friction, its entries in the same places. */
SlidingPencil without_friction(SlidingPencil pencil);

/**
 * How many eigenvalues in @p range are not among @p found, by the argument principle: the
 * turns of det [...] over that of @p still, which is without_friction(), along the border of
 * the range. Eigenvalues that the search does not know turn both alike, the farther the more
 * so; those that are known of either, @p found and @p found_still, are divided out. Steps are split,
 * not in the middle, until the phase turns by less than 0.7 rad in both parts, and evenly. A count
 * that finds some missing is repeated with three times the steps until two agree. How many
 * eigenvalues of @p still there are is known from the signs of pivots (Sylvester). Negative if not
 * all that was found is there. Factorizations are counted in @p report. @throws NotConverged if an
 * eigenvalue lies on the border
 */
int count_missing(const SlidingPencil &pencil,
                  const SlidingPencil &still,
                  ComplexFactorization &factors,
                  const CountedRange &range,
                  const std::vector<FoundMode> &found,
                  const std::vector<FoundMode> &found_still,
                  const ComplexModesOptions &options,
                  ComplexModes &report);
} // namespace mesoslip

#endif
