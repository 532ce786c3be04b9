#include "eigenvalues/complex/mode_count.h"

#include "material/plausibility.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;

/** Phases of det [...] without its known zeros. */
class Turns
{
public:
  Turns(const SlidingPencil &pencil,
        ComplexFactorization &factors,
        const std::vector<FoundMode> &found,
        const ComplexModesOptions &options,
        ComplexModes &report)
    : pencil(pencil)
    , factors(factors)
    , found(found)
    , options(options)
    , report(report)
  {
  }

  /** Takes away what eigenvalues far off do, about c s^2, as seen @p above a real @p s. */
  void straighten(const double s, const double above)
  {
    far = std::remainder(phase({s, above}) - phase(s), 2. * M_PI) / (2. * s * above);
  }

  /** By which the phase turns from @p a to @p b (rad), in @p n steps at least. */
  double between(const Complex a, const Complex b, const unsigned int n)
  {
    double turned  = 0.;
    Complex begin  = a;
    double phase_0 = phase(begin);
    for (unsigned int k = 1; k <= n; ++k)
      {
        const Complex end    = a + (b - a) * (static_cast<double>(k) / n);
        const double phase_1 = phase(end);
        turned += split({begin, phase_0}, {end, phase_1});
        begin   = end;
        phase_0 = phase_1;
      }
    return turned;
  }

private:
  /** A place on the border and the phase there. */
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
    // Not halves, of which both could turn by whole turns.
    constexpr double largest = 0.7, golden = 0.381966;
    if (!(std::abs(b.s - a.s) > 1e-9 * std::abs(b.s)))
      throw NotConverged(
        brief_text(8,
                   "an eigenvalue lies on the border of the range that is "
                   "counted, near ",
                   a.s.real(), " 1/s and ", a.s.imag() / (2. * M_PI),
                   " Hz; it moves with Fastest decay, Lowest and Highest frequency"));
    const Complex s = a.s + golden * (b.s - a.s);
    const Point middle{s, phase(s)};
    const double first = turn(a, middle), second = turn(middle, b);
    const double bend = first - golden * (first + second);
    if (std::max(std::fabs(first), std::fabs(second)) < largest &&
        std::fabs(bend) < 0.5 * largest)
      return first + second;
    return split(a, middle) + split(middle, b);
  }

  double phase(const Complex s)
  {
    if (options.before_factorization)
      options.before_factorization("the count of eigenvalues");
    factors.factorize(pencil(s));
    ++report.n_factorizations;
    double sum = factors.phase_of_determinant() - far * (s * s).imag();
    for (const FoundMode &mode : found)
      sum -= std::arg(s - mode.s) + std::arg(s - std::conj(mode.s));
    return sum;
  }

  const SlidingPencil &pencil;
  ComplexFactorization &factors;
  const std::vector<FoundMode> &found;
  const ComplexModesOptions &options;
  ComplexModes &report;
  double far = 0.; ///< c of straighten() (s^2)
};
} // namespace

int count_missing(const SlidingPencil &pencil,
                  ComplexFactorization &factors,
                  const SearchRange &range,
                  const std::vector<FoundMode> &found,
                  const ComplexModesOptions &options,
                  ComplexModes &report)
{
  const double low = range.bottom, top = range.top, decay = std::min(range.decay, top),
               right = range.right(low, top);
  Turns turns(pencil, factors, found, options, report);
  turns.straighten(right, 0.01 * top);
  const std::vector<std::pair<Complex, unsigned int>> corners = {
    {{0., low}, 1},
    {{right, low}, 2},
    {{right, top}, 16},
    {{-decay, top}, 4},
    {{-decay, std::max(decay, low)}, 16},
    {{-std::min(decay, low), low}, 1},
    {{0., low}, 1}};
  const auto count = [&](const unsigned int refinement) {
    double turned = 0.;
    for (std::size_t k = 1; k < corners.size(); ++k)
      if (corners[k].first != corners[k - 1].first)
        turned += turns.between(corners[k - 1].first, corners[k].first,
                                refinement * corners[k].second);
    return static_cast<int>(std::lround(turned / (2. * M_PI)));
  };
  // A step that turns by about whole turns is taken for none; finer ones are none.
  int missing = count(1);
  for (unsigned int refinement = 3; missing != 0 && refinement <= 27; refinement *= 3)
    {
      const int again = count(refinement);
      if (again == missing)
        break;
      missing = again;
    }
  return missing;
}
} // namespace mesoslip
