#include "eigenvalues/complex/growth_region.h"

#include "eigenvalues/complex/arnoldi.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
/** Bound of |u^H N u| / u^H K u with N = @p friction, see friction_radius(). */
double radius_of(const RealMatrix &friction, const SlidingPencil &pencil)
{
  using Complex = SlidingPencil::Complex;
  if (pencil.targets.rows() == 0 || friction.norm() == 0.)
    return 0.;
  const ComplexMatrix stiffness = pencil.whole_stiffness().cast<Complex>();
  ComplexFactorization factors(stiffness);
  factors.factorize(stiffness);
  const RealMatrix transposed = friction.transpose();
  const RealMatrix even       = 0.5 * (friction + transposed),
                   odd        = 0.5 * (friction - transposed);
  // The range is symmetric about the real axis, as N is real: a quarter turn suffices.
  constexpr int n_directions = 9;
  const double step          = 0.5 * M_PI / (n_directions - 1);
  double largest             = 0.;
  for (int k = 0; k < n_directions; ++k)
    {
      const ComplexMatrix turned = even.cast<Complex>() * Complex(std::cos(k * step)) +
                                   odd.cast<Complex>() * Complex(0., std::sin(k * step));
      const auto found = largest_eigenvalue(
        pencil.size(),
        [&](ComplexVector &dst, const ComplexVector &src) {
          factors.solve(dst, turned * src);
        },
        1e-6);
      if (!found)
        throw NotConverged("the strength of friction was not found: the Arnoldi "
                           "iteration did not converge");
      largest = std::max(largest, *found);
    }
  return 1.0001 * largest / std::cos(0.5 * step); // corners of the polygon
}
} // namespace

double friction_radius(const SlidingPencil &pencil)
{
  return pencil.yields() ? std::numeric_limits<double>::infinity()
                         : radius_of(pencil.whole_friction(), pencil);
}

namespace
{
/**
 * Bound of u^H C u / u^H M u for the symmetric @p matrix C and a diagonal M (or a
 * diagonal below M).
 */
double largest_rate(const RealMatrix &matrix, const Eigen::VectorXd &mass)
{
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(mass.size());
  for (Eigen::Index column = 0; column < matrix.outerSize(); ++column)
    for (RealMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      sums[entry.row()] += std::fabs(entry.value());
  return sums.cwiseQuotient(mass).maxCoeff();
}

} // namespace

FeedingDrag feeding_drag(const SlidingPencil &pencil)
{
  const RealMatrix &E = pencil.distribution;
  const double damped = radius_of(E * pencil.damped_targets, pencil);
  if (pencil.late_drag.nonZeros() == 0 && !(pencil.drag_of_slip.array() < 0.).any())
    return {0., 0., damped};
  return {largest_rate(E * pencil.drag, pencil.own_mass),
          largest_rate(E * pencil.late_drag, pencil.own_mass), damped};
}

double largest_growth(const SlidingPencil &pencil, const FeedingDrag &drag)
{
  // |s|^2 <= |1 + beta s| stiff + |s| feeding, what friction adds times |1/L(s)|
  const auto of_friction = [&](const RealMatrix &matrix) {
    return pencil.largest_response() * largest_rate(matrix, pencil.own_mass);
  };
  const double stiff = largest_rate(pencil.whole_stiffness(), pencil.own_mass) +
                       of_friction(pencil.whole_friction()),
               linear = pencil.law.beta * stiff +
                        pencil.largest_response() * (drag.at_once + drag.late) +
                        of_friction(pencil.distribution * pencil.damped_targets);
  return 0.5 * (linear + std::sqrt(linear * linear + 4. * stiff));
}

GrowthRegion::GrowthRegion(const SlidingLaw &law,
                           const double radius,
                           const FeedingDrag &drag)
  : law(law)
  , radius(radius)
  , drag(drag)
  , highest(std::numeric_limits<double>::infinity())
{
  const bool nothing_feeds =
    radius == 0. && drag.at_once == 0. && drag.late == 0. && drag.damped == 0.;
  if (nothing_feeds)
    highest = 0.;
  double low = 0., high = 1.;
  for (; excess(high) > 0. && high < 1e15; high *= 2.)
    low = high;
  if (nothing_feeds || !(high < 1e15))
    return;
  for (unsigned int n = 0; n < 100; ++n)
    {
      const double middle                = 0.5 * (low + high);
      (excess(middle) > 0. ? low : high) = middle;
    }
  highest = high;
}

double GrowthRegion::angle(const double omega) const
{
  const auto turn  = [](const double sine) { return sine < 1. ? std::asin(sine) : M_PI; };
  const double lag = std::hypot(1., omega * law.delta),
               feeding =
                 drag.at_once + drag.late / std::hypot(1., omega * law.state_time);
  return std::min(M_PI, turn((radius + M_SQRT2 * omega * drag.damped) / lag) +
                          (feeding > 0. ? turn(feeding / (omega * lag)) : 0.));
}

double GrowthRegion::excess(const double omega) const
{
  return angle(omega) - std::atan(law.beta * omega);
}

double GrowthRegion::largest_width(const double high) const
{
  constexpr unsigned int n = 200;
  double largest           = 0.;
  for (unsigned int k = 0; k < n; ++k)
    largest = std::max(largest, width(high * k / n, high * (k + 1) / n));
  return largest;
}

double GrowthRegion::width(const double low, const double high) const
{
  const double most = angle(low), undamped = high * std::tan(0.5 * most),
               damping = std::atan(law.beta * low / (1. + law.beta * undamped));
  return high * std::tan(0.5 * std::max(0., most - damping));
}
} // namespace mesoslip
