#ifndef mesoslip_eigenvalues_complex_growth_region_h
#define mesoslip_eigenvalues_complex_growth_region_h

#include "eigenvalues/complex/sliding_pencil.h"

namespace mesoslip
{
/**
 * Bound r of |u^H N u| / u^H K u over all complex u: the polygon around the numerical range
 * of N in the energy of K, from its support in nine directions. It depends neither on delta
 * nor on beta, and grows as the cells get smaller, like the root of their number along the
 * contact. @throws NotConverged, also if K is singular
 */
double friction_radius(const SlidingPencil &pencil);

/**
 * Where an eigenvalue s = a + i w with a, w >= 0 can be. u^H [...] u = 0 says that inertia
 * and stiffness, of which friction turns the latter by asin(r / |1 + s delta|) at most, sum
 * up to zero, so that where r < |1 + i w delta|
 *
 *     2 atan(a / w) + atan(beta w / (1 + beta a)) <= asin(r / |1 + i w delta|)
 *
 * with r = friction_radius(). The drag across the motion of the flat only takes energy and
 * leaves this bound. The left side grows with a, and for a = 0 with w; the right side
 * falls.
 */
class GrowthRegion
{
public:
  /** @p radius is friction_radius(). */
  GrowthRegion(const SlidingLaw &law, const double radius);

  /** Above this circular frequency (1/s) nothing grows; infinite where this does not say,
   * as without delta and beta. */
  double highest_frequency() const
  {
    return highest;
  }

  /** Bound of the growth rate (1/s) of circular frequencies from @p low to @p high, or
   * @p high where there is none below. */
  double width(const double low, const double high) const;

private:
  double angle(const double omega) const;
  double excess(const double omega) const;

  const SlidingLaw law;
  const double radius;
  double highest;
};
} // namespace mesoslip

#endif
