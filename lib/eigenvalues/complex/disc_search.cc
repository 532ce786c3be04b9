#include "eigenvalues/complex/disc_search.h"

#include "eigenvalues/complex/arnoldi.h"
#include "eigenvalues/complex/shifted_inverse.h"
#include "material/plausibility.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;

constexpr int fewest = 4;  // least number of eigenvalues per shift
constexpr int most   = 48; // largest number; beyond it, vectors cost more than factors

/** Relative distance of two results for the same eigenvalue. */
constexpr double same = 1e-7;
/** Rates of eigenvalues that only relax, hundreds of each: -1/delta and -1/tau of
 * friction forces and states. On springs delta differs by force; these are its ends. */
std::vector<double> exact_rates(const SlidingPencil &pencil)
{
  double longest = 0., shortest = std::numeric_limits<double>::infinity();
  for (const double lag : pencil.lag_at_once())
    if (lag > 0.)
      {
        longest  = std::max(longest, lag);
        shortest = std::min(shortest, lag);
      }
  std::vector<double> rates;
  for (const double time :
       {shortest < longest ? shortest : 0., longest, pencil.law.state_time})
    if (time > 0.)
      rates.push_back(1. / time);
  return rates;
}

/** Also that of nodes constrained by drag across the motion, in 3D. */
std::vector<double> relaxing_rates(const SlidingPencil &pencil)
{
  std::vector<double> rates   = exact_rates(pencil);
  const RealMatrix resistance = pencil.distribution * pencil.drag;
  double stiffest             = 0.;
  for (Eigen::Index k = 0; k < resistance.outerSize(); ++k)
    if (const double drag = resistance.coeff(k, k); drag > 0.)
      {
        const double stiffness = pencil.stiffness.coeff(k, k);
        stiffest               = std::max(
                        stiffest, stiffness / (drag * (1. + stiffness * pencil.slack.maxCoeff())));
      }
  if (stiffest > 0.)
    rates.push_back(stiffest);
  return rates;
}
} // namespace

DiscSearch::DiscSearch(const SlidingPencil &pencil,
                       ComplexFactorization &factors,
                       const ComplexModesOptions &options,
                       ComplexModes &report)
  : pencil(pencil)
  , factors(factors)
  , options(options)
  , report(report)
  , relaxing(relaxing_rates(pencil))
  , n_exact(exact_rates(pencil).size())
{
}

std::vector<double> DiscSearch::left_out(const double bottom) const
{
  std::vector<double> slow;
  for (std::size_t k = 0; k < relaxing.size(); ++k)
    if (relaxing[k] < bottom || (leaves_out_exact && k < n_exact))
      slow.push_back(relaxing[k]);
  return slow;
}

std::optional<DiscSearch::Disc> DiscSearch::nearest(const Complex centre,
                                                    const int count,
                                                    const unsigned int seed,
                                                    const SearchRange &range,
                                                    const double edge,
                                                    const double left)
{
  if (options.before_factorization)
    options.before_factorization("Search",
                                 (edge - range.bottom) / (range.top - range.bottom));
  factors.factorize(pencil(centre));
  ++report.n_factorizations;
  ++report.n_shifts;
  report.factor_bytes = std::max(report.factor_bytes, factors.bytes());
  const ShiftedInverse inverse(pencil, factors, centre, std::abs(centre));
  const auto solve = [&](ComplexVector &dst, const ComplexVector &src) {
    inverse.vmult(dst, src);
    ++report.n_solves;
  };
  const std::vector<double> slow = left_out(2. * M_PI * options.lowest_frequency);
  ArnoldiOptions arnoldi_options;
  arnoldi_options.count           = count;
  arnoldi_options.tolerance       = 0.01 * options.tolerance;
  arnoldi_options.most_iterations = 30;
  arnoldi_options.seed            = seed;
  const auto pairs                = arnoldi(
                   pencil.state_size(),
                   [&](ComplexVector &dst, const ComplexVector &src) {
      solve(dst, src);
      for (const double rate : slow)
        {
          const ComplexVector once = dst;
          solve(dst, once);
          dst -= once / (-rate - centre);
        }
    },
                   arnoldi_options);
  if (!pairs || pairs->values.size() < count)
    return std::nullopt;
  ComplexVector image;
  for (Eigen::Index k = 0; k < pairs->values.size(); ++k)
    {
      const ComplexVector x = pairs->vectors.col(k);
      Complex value         = pairs->values[k];
      if (!slow.empty())
        {
          solve(image, x);
          value = x.dot(image);
        }
      keep(centre + 1. / value, x.head(pencil.size()));
    }
  double farthest = 1. / std::abs(pairs->values[pairs->values.size() - 1]);
  for (const double rate : slow)
    farthest *= std::max(edge, rate + left) / std::abs(centre + rate);
  return Disc{centre, std::pow(farthest, 1. / (1. + static_cast<double>(slow.size())))};
}

void DiscSearch::keep(const Complex s, ComplexVector u)
{
  // Real eigenvalues are no vibrations; one of a conjugate pair suffices.
  if (!(s.imag() > 1e-9 * std::abs(s)))
    return;
  const auto product = [this](const ComplexVector &a, const ComplexVector &b) {
    return a.dot(mesoslip::product(pencil.mass, b));
  };
  u /= std::sqrt(product(u, u).real());
  ComplexVector rest = u;
  std::vector<ComplexVector> basis;
  for (const FoundMode &other : modes)
    if (std::abs(other.s - s) < same * std::abs(s))
      {
        ComplexVector direction = other.u;
        for (const ComplexVector &b : basis)
          direction -= product(b, direction) * b;
        direction /= std::sqrt(product(direction, direction).real());
        rest -= product(direction, rest) * direction;
        basis.push_back(direction);
      }
  if (product(rest, rest).real() > 1e-4)
    modes.push_back({s, std::move(u)});
}

void DiscSearch::cover(const SearchRange &range, const unsigned int seed)
{
  const int largest = static_cast<int>(
    std::min<Eigen::Index>(most, std::max<Eigen::Index>(1, pencil.state_size() / 4)));
  const int all      = std::max(largest, static_cast<int>(pencil.state_size() / 4));
  const auto is_free = [&](const Complex centre, const double radius) {
    return !left_out(range.bottom).empty() ||
           std::all_of(relaxing.begin(), relaxing.end(), [&](const double rate) {
             return radius < 0.6 * std::abs(centre + rate);
           });
  };
  int count   = std::min(6, largest);
  double edge = range.bottom, reach = 0.1 * (range.top - range.bottom);
  while (edge < range.top)
    {
      const double middle = edge + 0.85 * reach, high = middle + reach;
      const double left = range.left(high), right = range.right(edge, high);
      const double half = 0.5 * (right - left);
      const auto disc =
        nearest(Complex(0.5 * (left + right), middle), count, seed, range, edge, left);
      if (!disc)
        {
          // Rates of nodes constrained by a slow flat are not exact, and remain.
          const bool is_held = std::any_of(
            relaxing.begin() + static_cast<std::ptrdiff_t>(n_exact), relaxing.end(),
            [&](const double rate) { return rate < 0.01 * range.top; });
          if (count <= fewest && !leaves_out_exact && n_exact > 0 && !is_held)
            {
              leaves_out_exact = true; // needs as many additional solves
              continue;
            }
          if (count <= fewest)
            throw NotConverged(brief_text(4,
                                          "the Arnoldi iteration did not converge near ",
                                          1e-3 * middle / (2. * M_PI), " kHz"));
          count = std::max(fewest, count / 2);
          continue;
        }
      const double covered = std::min(
        reach, std::sqrt(std::max(0., disc->radius * disc->radius - half * half)));
      if (middle - covered > edge)
        {
          if (!(reach > 1e-6 * range.top))
            throw NotConverged(
              brief_text(4, "too many modes near ", 1e-3 * middle / (2. * M_PI), " kHz"));
          // A disc narrower than the range covers nothing, whatever its vectors cost.
          if (covered < 0.5 * reach && is_free(disc->centre, disc->radius))
            count = std::min(covered > 0. ? std::max(largest, count) : all, 2 * count);
          reach = std::max(0.9 * covered, 0.5 * reach);
          continue;
        }
      edge  = middle + covered;
      reach = 1.4 * covered;
      if (is_free(disc->centre, 1.5 * disc->radius))
        count = std::min(largest, 3 * count / 2);
    }
}
} // namespace mesoslip
