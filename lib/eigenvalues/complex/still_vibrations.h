#ifndef mesoslip_eigenvalues_complex_still_vibrations_h
#define mesoslip_eigenvalues_complex_still_vibrations_h

#include "eigenvalues/complex/sliding_pencil.h"

#include <algorithm>
#include <functional>
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
/** Vibrations that are slowest. */
struct LowestVibrations
{
  std::vector<double> squares;         ///< of circular frequencies (1/s^2), ascending
  std::vector<Eigen::VectorXd> shapes; ///< of each, u^T M u = 1
  unsigned int n_rigid  = 0; ///< motions that nothing holds, which are not among these
  unsigned int n_solves = 0; ///< with shifts of the stiffness
};

/**
 * The @p n slowest vibrations of a pencil without friction that are not rigid motions, as many by the signs of pivots, as in
 * find_still(). A square below 1e-9 @p unit (1/s^2), or one that round-off could make, is that of a rigid motion.
 * @p before_solve is called with the number of solves. @throws NotConverged
 */
LowestVibrations lowest_vibrations(const SlidingPencil &still,
                                   const int n,
                                   const double unit,
                                   const double tolerance,
                                   const std::function<void(unsigned int)> &before_solve);
} // namespace mesoslip

#endif
