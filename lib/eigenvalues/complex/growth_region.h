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

/** What drag that feeds energy adds to growth at most. */
struct FeedingDrag
{
  double at_once = 0.; ///< largest eigenvalue of |C_0| in the metric of M (1/s)
  double late    = 0.; ///< of |C_1|, which lags behind by tau (1/s)
  double damped  = 0.; ///< bound of |u^H N_d u| / u^H K u, as friction_radius() (s)
};

/** No s that grows is larger than this (1/s), from the largest sums of rows of K and N over the
 * mass. */
double largest_growth(const SlidingPencil &pencil, const FeedingDrag &drag);

/** Zeros if the drag of @p pencil only takes energy, C_0 >= 0, C_1 = 0, and damping does not differ by phase.
 * @throws NotConverged */
FeedingDrag feeding_drag(const SlidingPencil &pencil);

/**
 * Where an eigenvalue s = a + i w with a, w >= 0 can be. u^H [...] u = 0 says that inertia,
 * stiffness and drag sum up to zero. Friction turns the stiffness by asin(r / |1 + s delta|)
 * at most, r = friction_radius(). A drag that only takes energy points to the same side of
 * inertia and stiffness as these together and cannot help them to cancel. One that feeds energy, as
 * where mu falls with the slip rate, is taken as a part of inertia: its size over that of
 * inertia is u^H C u / (|s| |1 + s delta| u^H M u), so it turns inertia by asin of
 * g / (w |1 + i w delta|) at most, with g = c_0 + c_1 / |1 + i w tau| of feeding_drag(). So, as
 * long as both sines are below one,
 *
 *     2 atan(a / w) + atan(beta w / (1 + beta a))
 *       <= asin(r / |1 + i w delta|) + asin(g / (w |1 + i w delta|))
 *
 * Damping by phase adds w sqrt(2) |N_d| to r, for a up to w.
 *
 * Springs below the nodes are not damped: the force of the body and them together then points
 * somewhere between those of an undamped and a damped stiffness, and the term with beta is left out.
 *
 * The left side grows with a, and for a = 0 with w; the right side falls. c_0 and c_1 grow
 * in proportion to the inverse of the size of the cells: half of c_0 is the growth of a node
 * by itself.
 */
class GrowthRegion
{
public:
  /** @p radius is friction_radius(), @p drag feeding_drag(). */
  GrowthRegion(const SlidingLaw &law, const double radius, const FeedingDrag &drag = {});

  /** Above this circular frequency (1/s) nothing grows; infinite where this does not say,
   * as without delta and beta. */
  double highest_frequency() const
  {
    return highest;
  }

  /** Bound of the growth rate (1/s) of circular frequencies from @p low to @p high, or
   * @p high where there is none below. */
  double width(const double low, const double high) const;

  /** The same of all frequencies up to @p high, part by part. */
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
