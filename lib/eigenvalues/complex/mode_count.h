#ifndef mesoslip_eigenvalues_complex_mode_count_h
#define mesoslip_eigenvalues_complex_mode_count_h

#include "eigenvalues/complex/disc_search.h"

namespace mesoslip
{
/**
 * How many eigenvalues in @p range are not among @p found, by the argument principle: the
 * turns of det [...] over the product of (s - s_k) and (s - conj s_k) along the border of
 * the range, in steps that are split, not in the middle, until the phase turns by less
 * than 0.7 rad in both parts, and evenly. A count that finds some missing is repeated with
 * three times the steps until two agree. Negative if not all that was found is there.
 * Factorizations are counted in @p report. @throws NotConverged if an eigenvalue lies on
 * the border
 */
int count_missing(const SlidingPencil &pencil,
                  ComplexFactorization &factors,
                  const SearchRange &range,
                  const std::vector<FoundMode> &found,
                  const ComplexModesOptions &options,
                  ComplexModes &report);
} // namespace mesoslip

#endif
