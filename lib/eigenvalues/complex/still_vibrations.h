#ifndef mesoslip_eigenvalues_complex_still_vibrations_h
#define mesoslip_eigenvalues_complex_still_vibrations_h

#include "eigenvalues/complex/sliding_pencil.h"

#include <algorithm>
#include <vector>

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

/** The pencil without friction, its entries in the same places. Its vibrations are those of the
 * symmetric problem K u = x M u, s^2 + beta x s + x = 0. */
SlidingPencil without_friction(SlidingPencil pencil);

/** Number of eigenvalues of a pencil without friction in @p range, from the signs of pivots (Sylvester).
 * @throws NotConverged */
int count_still(const SlidingPencil &still, const CountedRange &range);

/** These eigenvalues, to the relative @p tolerance: Arnoldi iterations with shifts of K - x M, in parts of the range
 * that have 30 at most by the signs of pivots. @throws NotConverged if they are not all found */
std::vector<SlidingPencil::Complex>
find_still(const SlidingPencil &still, const CountedRange &range, const double tolerance);
} // namespace mesoslip

#endif
