#ifndef mesoslip_eigenvalues_complex_mode_count_h
#define mesoslip_eigenvalues_complex_mode_count_h

#include "eigenvalues/complex/disc_search.h"
#include "eigenvalues/complex/still_vibrations.h"

namespace mesoslip
{
/** The middle of the widest gap between @p from, @p to and those @p values that lie between. */
double widest_gap(const double from, const double to, std::vector<double> values);

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
                  const std::vector<SlidingPencil::Complex> &found_still,
                  const ComplexModesOptions &options,
                  ComplexModes &report);
} // namespace mesoslip

#endif
