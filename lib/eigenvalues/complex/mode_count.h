#ifndef mesoslip_eigenvalues_complex_mode_count_h
#define mesoslip_eigenvalues_complex_mode_count_h

#include "eigenvalues/complex/disc_search.h"
#include "eigenvalues/complex/still_vibrations.h"

namespace mesoslip
{
/** Middle of the widest gap between @p from, @p to and the @p values in between. */
double widest_gap(const double from, const double to, std::vector<double> values);

/**
 * Number of eigenvalues in @p range that are not in @p found, by the argument principle:
 * turns of det [...] over that of @p still = without_friction() along the border of the
 * range. Unknown eigenvalues turn both alike, the more so the farther away; known ones,
 * @p found and @p found_still, are divided out. Steps are split, not in the middle, until
 * the phase turns by less than 0.7 rad in both parts, and evenly. A nonzero count is
 * repeated with three times the steps until two agree. The number of eigenvalues of
 * @p still follows from the signs of pivots (Sylvester). The result is negative if fewer
 * eigenvalues are counted than were found. Factorizations are counted in @p report.
 * @throws NotConverged if an eigenvalue lies on the border
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
