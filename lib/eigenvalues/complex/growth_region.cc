#include "eigenvalues/complex/growth_region.h"

#include "eigenvalues/complex/arnoldi.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
double friction_radius(const SlidingPencil &pencil)
{
  using Complex = SlidingPencil::Complex;
  if (pencil.rows.empty() || pencil.friction.norm() == 0.)
    return 0.;
  const ComplexMatrix stiffness = pencil.stiffness.cast<Complex>();
  ComplexFactorization factors(stiffness);
  factors.factorize(stiffness);
  const RealMatrix transposed = pencil.friction.transpose();
  const RealMatrix even       = 0.5 * (pencil.friction + transposed),
                   odd        = 0.5 * (pencil.friction - transposed);
  // The range is symmetric to the real axis, as N is real, so a quarter turn is enough.
  constexpr int n_directions = 9;
  const double step          = 0.5 * M_PI / (n_directions - 1);
  double largest             = 0.;
  for (int k = 0; k < n_directions; ++k)
    {
      const ComplexMatrix turned = even.cast<Complex>() * Complex(std::cos(k * step)) +
                                   odd.cast<Complex>() * Complex(0., std::sin(k * step));
      ArnoldiOptions options;
      options.count     = 2;
      options.tolerance = 1e-6;
      const auto found  = arnoldi(
         pencil.size(),
         [&](ComplexVector &dst, const ComplexVector &src) {
          factors.solve(dst, turned * src);
        },
         options);
      if (!found)
        throw NotConverged("the strength of friction was not found: the Arnoldi "
                           "iteration did not converge");
      largest = std::max(largest, std::abs(found->values[0]));
    }
  return 1.0001 * largest / std::cos(0.5 * step); // corners of the polygon
}

GrowthRegion::GrowthRegion(const SlidingLaw &law, const double radius)
  : law(law)
  , radius(radius)
  , highest(std::numeric_limits<double>::infinity())
{
  if (radius == 0.)
    highest = 0.;
  double low = 0., high = 1.;
  for (; excess(high) > 0. && high < 1e15; high *= 2.)
    low = high;
  if (radius == 0. || !(high < 1e15))
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
  return std::asin(std::min(1., radius / std::hypot(1., omega * law.delta)));
}

double GrowthRegion::excess(const double omega) const
{
  return angle(omega) - std::atan(law.beta * omega);
}

double GrowthRegion::width(const double low, const double high) const
{
  const double most = angle(low), undamped = high * std::tan(0.5 * most),
               damping = std::atan(law.beta * low / (1. + law.beta * undamped));
  return high * std::tan(0.5 * std::max(0., most - damping));
}
} // namespace mesoslip
