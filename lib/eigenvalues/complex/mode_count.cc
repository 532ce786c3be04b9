#include "eigenvalues/complex/mode_count.h"

#include "material/plausibility.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;

/** A pencil and eigenvalues that are divided out of its determinant. */
struct Divided
{
  const SlidingPencil &pencil;
  std::vector<Complex> zeros; ///< includes their conjugates
};

/**
 * Makes both lists equally long, so that both determinants turn alike far away. Pairs
 * each of @p above, starting with those that friction moved least, with the nearest of
 * @p below. Unpaired eigenvalues represent fast decaying ones of the other list, which
 * are placed at a distance @p away.
 */
void pair(std::vector<Complex> &above, std::vector<Complex> &below, const double away)
{
  double highest = 0.;
  for (const Complex s : above)
    highest = std::max(highest, s.imag());
  below.erase(std::remove_if(below.begin(), below.end(),
                             [&](const Complex s) { return s.imag() > highest; }),
              below.end());
  std::sort(above.begin(), above.end(), [](const Complex a, const Complex b) {
    return std::fabs(a.real()) < std::fabs(b.real());
  });
  std::vector<Complex> left = below;
  for (const Complex s : above)
    if (left.empty())
      below.emplace_back(-away, s.imag());
    else
      left.erase(
        std::min_element(left.begin(), left.end(), [s](const Complex a, const Complex b) {
          return std::abs(a - s) < std::abs(b - s);
        }));
  for (const Complex s : left)
    above.emplace_back(-away, s.imag());
}

/**
 * Phase of det [...] of one pencil over that of another, both without their known zeros.
 */
class Turns
{
public:
  Turns(const Divided &above,
        const Divided &below,
        ComplexFactorization &factors,
        const ComplexModesOptions &options,
        ComplexModes &report)
    : above(above)
    , below(below)
    , factors(factors)
    , options(options)
    , report(report)
  {
  }

  /**
   * Phase change from @p a to @p b (rad), in at least @p n steps. They are the share
   * @p part of the border, beginning at share @p from.
   */
  double between(const Complex a,
                 const Complex b,
                 const unsigned int n,
                 const double from,
                 const double part)
  {
    double turned = 0.;
    Point begin   = at(a);
    for (unsigned int k = 1; k <= n; ++k)
      {
        share           = from + part * (k - 1) / n;
        const Point end = at(a + (b - a) * (static_cast<double>(k) / n));
        turned += split(begin, end);
        begin = end;
      }
    return turned;
  }

private:
  /** A point on the border and its phase. */
  struct Point
  {
    Complex s;
    double phase;
  };

  static double turn(const Point &from, const Point &to)
  {
    return std::remainder(to.phase - from.phase, 2. * M_PI);
  }

  double split(const Point &a, const Point &b)
  {
    // Not halves: in both halves the phase could turn by full turns.
    constexpr double largest = 0.7, golden = 0.381966;
    if (!(std::abs(b.s - a.s) > 1e-9 * std::abs(b.s)))
      throw NotConverged(
        brief_text(8,
                   "an eigenvalue lies on the border of the range that is "
                   "counted, near ",
                   a.s.real(), " 1/s and ", a.s.imag() / (2. * M_PI),
                   " Hz; it moves with Fastest decay, Lowest and Highest frequency"));
    const Point middle = at(a.s + golden * (b.s - a.s));
    const double first = turn(a, middle), second = turn(middle, b);
    const double bend = first - golden * (first + second);
    if (std::max(std::fabs(first), std::fabs(second)) < largest &&
        std::fabs(bend) < 0.5 * largest)
      return first + second;
    return split(a, middle) + split(middle, b);
  }

  /** Evaluates the phase at @p s; corners of the border are requested twice. */
  Point at(const Complex s)
  {
    if (s != latest.s)
      {
        if (options.before_factorization)
          options.before_factorization("Count", share);
        latest = {s, phase(above, s) - phase(below, s)};
      }
    return latest;
  }

  double phase(const Divided &of, const Complex s)
  {
    factors.factorize(of.pencil(s));
    ++report.n_factorizations;
    // Both pencils are divided by 1 + beta s; beta differs if damping differs by phase.
    double sum = factors.phase_of_determinant() + static_cast<double>(of.pencil.size()) *
                                                    std::arg(1. + of.pencil.law.beta * s);
    for (const Complex zero : of.zeros)
      sum -= std::arg(s - zero) + std::arg(s - std::conj(zero));
    return sum;
  }

  double share = 0.; ///< share of the border that is done
  Point latest = {std::numeric_limits<double>::quiet_NaN(), 0.};
  const Divided above, below;
  ComplexFactorization &factors;
  const ComplexModesOptions &options;
  ComplexModes &report;
};

/** Whether @p s vibrates. Eigenvalues that relax, those near -1/delta and -1/tau, cancel poles of the
 * determinant nearly: divided out alone they would leave the poles, around which the phase turns
 * several times within a step. None of them is counted. */
bool vibrates(const Complex s)
{
  return s.imag() > -s.real();
}

std::vector<Complex> vibrations_of(const std::vector<FoundMode> &modes)
{
  std::vector<Complex> numbers;
  for (const FoundMode &mode : modes)
    if (vibrates(mode.s))
      numbers.push_back(mode.s);
  return numbers;
}

/** Number of @p zeros inside @p range. */
int count_in(const std::vector<Complex> &zeros, const CountedRange &range)
{
  return static_cast<int>(std::count_if(
    zeros.begin(), zeros.end(), [&](const Complex s) { return range.contains(s); }));
}
} // namespace

double widest_gap(const double from, const double to, std::vector<double> values)
{
  values.insert(values.end(), {from, to});
  std::sort(values.begin(), values.end());
  double middle = from, width = 0.;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k - 1] >= from && values[k] <= to && values[k] - values[k - 1] > width)
      {
        width  = values[k] - values[k - 1];
        middle = 0.5 * (values[k] + values[k - 1]);
      }
  return middle;
}

int count_missing(const SlidingPencil &pencil,
                  const SlidingPencil &still,
                  ComplexFactorization &factors,
                  const CountedRange &range,
                  const std::vector<FoundMode> &found,
                  const std::vector<Complex> &found_still,
                  const ComplexModesOptions &options,
                  ComplexModes &report)
{
  const double low = range.low, top = range.top,
               decay = std::min(range.decay, range.steep * top), right = range.right,
               corner = decay / range.steep;
  // The reference gets the poles of the pencil, as if it had no such eigenvalues.
  std::vector<Complex> poles = pencil.poles();
  Divided above{pencil, vibrations_of(found)}, below{still, found_still};
  below.zeros.insert(below.zeros.end(), poles.begin(), poles.end());
  const int n_found = count_in(above.zeros, range);
  pair(above.zeros, below.zeros, decay + 0.1 * top);
  // Eigenvalues in the range that are not divided out.
  const int unknown = count_still(still, range) + count_in(poles, range) -
                      count_in(below.zeros, range) -
                      (n_found - count_in(above.zeros, range));
  Turns turns(above, below, factors, options, report);
  const double near = std::min(right, 0.3 * top), far = std::sqrt(near * right);
  const std::vector<std::pair<Complex, unsigned int>> corners = {
    {{0., low}, 1},
    {{near, low}, 1},
    {{far, low}, 1},
    {{right, low}, 1},
    {{right, top}, 1},
    {{far, top}, 1},
    {{near, top}, 1},
    {{-decay, top}, 4},
    {{-decay, std::max(corner, low)}, 8},
    {{-std::min(decay, range.steep * low), low}, 1},
    {{0., low}, 1}};
  const auto count = [&](const unsigned int refinement) {
    double turned = 0.;
    for (std::size_t k = 1; k < corners.size(); ++k)
      if (corners[k].first != corners[k - 1].first)
        turned += turns.between(
          corners[k - 1].first, corners[k].first, refinement * corners[k].second,
          (k - 1.) / (corners.size() - 1.), 1. / (corners.size() - 1.));
    return static_cast<int>(std::lround(turned / (2. * M_PI)) + unknown);
  };
  // A step of about full turns is mistaken for none; finer steps are not.
  int missing = count(1);
  for (unsigned int refinement = 3; missing != 0 && refinement <= 27; refinement *= 3)
    {
      const int again = count(refinement);
      if (again == missing && missing > 0)
        break;
      missing = again;
    }
  return missing;
}
} // namespace mesoslip
