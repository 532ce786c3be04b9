#ifndef mesoslip_eigenvalues_complex_still_vibrations_h
#define mesoslip_eigenvalues_complex_still_vibrations_h

#include "eigenvalues/complex/sliding_pencil.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace mesoslip
{
/** Region of the count, derived from a SearchRange. */
struct CountedRange
{
  double low   = 0.; ///< lowest circular frequency (1/s)
  double top   = 0.; ///< highest circular frequency (1/s)
  double decay = 0.; ///< largest decay rate (1/s)
  double right = 0.; ///< largest growth rate (1/s)
  double steep = 1.; ///< largest ratio of decay rate to circular frequency

  /** Whether @p s lies inside. */
  bool contains(const SlidingPencil::Complex s) const
  {
    return s.imag() > low && s.imag() < top && s.real() < right &&
           s.real() > -std::min(decay, steep * s.imag());
  }
};

/**
 * The pencil without friction, with the same sparsity patterns. Its vibrations solve the
 * symmetric problem K u = x M u, s^2 + beta x s + x = 0.
 */
SlidingPencil without_friction(SlidingPencil pencil);

/**
 * Number of eigenvalues of a pencil without friction in @p range, from the signs of
 * pivots (Sylvester). @throws NotConverged
 */
int count_still(const SlidingPencil &still, const CountedRange &range);

/**
 * Eigenvalues of a pencil without friction in @p range, to the relative @p tolerance:
 * Arnoldi iterations with shifts of K - x M, in parts of the range with at most 30
 * eigenvalues by the signs of pivots. @throws NotConverged unless all are found
 */
std::vector<SlidingPencil::Complex>
find_still(const SlidingPencil &still, const CountedRange &range, const double tolerance);
/** The lowest vibrations. */
struct LowestVibrations
{
  std::vector<double> squares;         ///< circular frequencies squared (1/s^2)
  std::vector<Eigen::VectorXd> shapes; ///< shapes, normalized to u^T M u = 1
  unsigned int n_rigid  = 0; ///< unconstrained rigid motions, not contained in squares
  unsigned int n_solves = 0; ///< solves with the shifted stiffness
};

/**
 * The @p n lowest vibrations of a pencil without friction, except rigid motions, counted
 * by the signs of pivots as in find_still(). A square below 1e-9 @p unit (1/s^2), or
 * within round-off of zero, counts as a rigid motion. @p before_solve is called with the
 * number of solves. @throws NotConverged
 */
LowestVibrations lowest_vibrations(const SlidingPencil &still,
                                   const int n,
                                   const double unit,
                                   const double tolerance,
                                   const std::function<void(unsigned int)> &before_solve);
} // namespace mesoslip

#endif
