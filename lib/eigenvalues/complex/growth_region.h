#ifndef mesoslip_eigenvalues_complex_growth_region_h
#define mesoslip_eigenvalues_complex_growth_region_h

#include "eigenvalues/complex/sliding_pencil.h"

namespace mesoslip
{
/**
 * Bound r of |u^H N u| / u^H K u over all complex u: the polygon around the numerical
 * range of N in the energy of K, from its support in nine directions. It does not depend
 * on delta or beta, and grows with mesh refinement, like the square root of the number of
 * cells along the contact. @throws NotConverged, also if K is singular
 */
double friction_radius(const SlidingPencil &pencil);

/** Bounds of the growth by drag that feeds energy. */
struct FeedingDrag
{
  double at_once = 0.; ///< largest eigenvalue of |C_0| in the metric of M (1/s)
  double late    = 0.; ///< largest eigenvalue of |C_1|, which lags by tau (1/s)
  double damped  = 0.; ///< bound of |u^H N_d u| / u^H K u, as friction_radius() (s)
};

/**
 * Upper bound of |s| of growing eigenvalues (1/s), from the largest row sums of K and N
 * over the mass.
 */
double largest_growth(const SlidingPencil &pencil, const FeedingDrag &drag);

/**
 * Bounds for @p pencil; zeros if its drag only dissipates, C_0 >= 0, C_1 = 0, and damping
 * does not differ by phase. @throws NotConverged
 */
FeedingDrag feeding_drag(const SlidingPencil &pencil);

/**
 * Region in which an eigenvalue s = a + i w with a, w >= 0 can lie. u^H [...] u = 0
 * states that inertia, stiffness and drag sum to zero. Friction rotates the stiffness in
 * the complex plane by at most asin(r / |1 + s delta|), r = friction_radius().
 * Dissipative drag points to the same side as inertia and stiffness together and cannot
 * help them to cancel. Drag that feeds energy, as where mu falls with the slip rate, is
 * added to the inertia: its size relative to inertia is u^H C u / (|s| |1 + s delta| u^H
 * M u), so that it rotates inertia by at most asin of g / (w |1 + i w delta|), with g =
 * c_0 + c_1 / |1 + i w tau| of feeding_drag(). As long as both sines are below one,
 *
 *     2 atan(a / w) + atan(beta w / (1 + beta a))
 *       <= asin(r / |1 + i w delta|) + asin(g / (w |1 + i w delta|))
 *
 * Damping by phase adds w sqrt(2) |N_d| to r, for a up to w.
 *
 * Springs below the nodes are not damped: the total force of body and springs then lies
 * between the forces of an undamped and of a damped stiffness, and the term with beta is
 * omitted.
 *
 * The left side grows with a, and for a = 0 with w; the right side falls. c_0 and c_1 are
 * inversely proportional to the cell size: half of c_0 is the growth rate of an isolated
 * node.
 */
class GrowthRegion
{
public:
  /** @p radius from friction_radius(), @p drag from feeding_drag(). */
  GrowthRegion(const SlidingLaw &law, const double radius, const FeedingDrag &drag = {});

  /**
   * Circular frequency (1/s) above which nothing grows; infinite if there is no such
   * bound, as without delta and beta.
   */
  double highest_frequency() const
  {
    return highest;
  }

  /**
   * Bound of the growth rate (1/s) for circular frequencies from @p low to @p high;
   * @p high if there is no smaller bound.
   */
  double width(const double low, const double high) const;

  /**
   * Bound of the growth rate (1/s) for all frequencies up to @p high, interval by
   * interval.
   */
  double largest_width(const double high) const;

private:
  double angle(const double omega) const;
  double excess(const double omega) const;

  const SlidingLaw law;
  const double radius;
  const FeedingDrag drag;
  double highest;
};
} // namespace mesoslip

#endif
