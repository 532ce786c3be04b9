#include "eigenvalues/complex/complex_modes.h"

#include "eigenvalues/complex/arnoldi.h"
#include "eigenvalues/complex/disc_search.h"
#include "eigenvalues/complex/mode_count.h"
#include "material/plausibility.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;

/**
 * Range for the count, with borders in gaps between all known eigenvalues. @p range has
 * the known eigenvalues, @p bottom to @p top is the requested interval.
 */
CountedRange quiet_range(const SearchRange &range,
                         const double wanted,
                         const double bottom,
                         const double top,
                         std::vector<Complex> known,
                         const std::vector<FoundMode> &found)
{
  for (const FoundMode &mode : found)
    known.push_back(mode.s);
  std::vector<double> decay, frequency;
  for (const Complex s : known)
    {
      decay.push_back(-s.real());
      frequency.push_back(s.imag());
    }
  CountedRange result;
  result.steep = range.steep;
  result.decay = widest_gap(wanted, range.decay, decay);
  result.top   = widest_gap(top, range.top, frequency);
  // Off the real axis, where growth without vibration is possible.
  result.low = bottom > 0. ? widest_gap(range.bottom, bottom, frequency)
                           : widest_gap(0., 1e-3 * top, frequency);
  return result;
}

/**
 * If fewer modes of @p range were found than there are without friction, searches faster
 * decaying modes, too. The border of the count then lies beyond the crowd of modes, where
 * the phase turns slowly. @return largest decay rate up to which all modes are known
 * (1/s)
 */
double search_for_count(const SearchRange &range,
                        const std::vector<Complex> &vibrations,
                        DiscSearch &search)
{
  const auto is_light = [&range](const Complex s) { return range.is_light(s); };
  const auto n_light =
    std::count_if(search.found().begin(), search.found().end(),
                  [&](const FoundMode &mode) { return is_light(mode.s); });
  if (n_light + 5 > std::count_if(vibrations.begin(), vibrations.end(), is_light))
    return range.decay;
  SearchRange rest = range;
  rest.most        = -0.9 * range.decay;
  rest.bottom      = range.top; // few modes lie below the lowest vibration
  for (const Complex s : vibrations)
    rest.bottom = std::min(rest.bottom, 0.9 * s.imag());
  rest.bottom = std::max({rest.bottom, range.bottom, range.decay / range.steep});
  for (const FoundMode &mode : search.found())
    if (range.is_light(mode.s))
      rest.decay = std::max(rest.decay, -1.15 * mode.s.real());
  try
    {
      search.cover(rest, 1);
    }
  catch (const NotConverged &)
    {
      return range.decay; // the count only takes longer
    }
  return rest.decay;
}

/**
 * Upper bound of the circular frequency of vibrations (1/s), slightly above the highest
 * one, without friction or with instantaneous friction; drag at most holds nodes on the
 * springs along the flat.
 */
double highest_vibration(const SlidingPencil &pencil)
{
  const RealMatrix friction = pencil.whole_friction();
  RealMatrix stiffness      = pencil.whole_stiffness();
  const Eigen::VectorXd along =
    (pencil.yielding() > 0.).select(pencil.slack.array().inverse(), 0.);
  stiffness += RealMatrix(pencil.distribution * along.asDiagonal()) *
               RealMatrix(pencil.distribution.transpose());
  const Eigen::SimplicialLDLT<RealMatrix> masses(pencil.mass);
  double largest = 0.;
  for (const double share : {0., 1.})
    {
      const auto found = largest_eigenvalue(
        pencil.size(),
        [&](ComplexVector &dst, const ComplexVector &src) {
          const ComplexVector force =
            product(stiffness, src) - share * product(friction, src);
          dst.resize(src.size());
          dst.real() = masses.solve(force.real());
          dst.imag() = masses.solve(force.imag());
        },
        1e-3);
      if (!found)
        return std::numeric_limits<double>::infinity();
      largest = std::max(largest, *found);
    }
  return 1.05 * std::sqrt(largest);
}

/**
 * Residual, and contributions to the growth of the mode: Re(v^H f) over v^H M v + u^H K
 * u.
 */
ComplexMode finish(const SlidingPencil &pencil, const FoundMode &found)
{
  ComplexMode mode;
  mode.s        = found.s;
  mode.shape    = product(pencil.free, found.u);
  mode.residual = pencil.residual(found.s, found.u);

  const auto form = [&](const RealMatrix &matrix) {
    return found.u.dot(product(matrix, found.u)).real();
  };
  const double elastic = form(pencil.stiffness), speed = std::norm(found.s),
               kinetic = speed * form(pencil.mass),
               energy  = kinetic + elastic + form(pencil.springs);
  mode.growth_by_damping =
    -speed * (pencil.law.beta * elastic + form(pencil.resistances)) / energy;
  const ComplexVector force = pencil.friction_force(found.s, found.u);
  const auto n_nodes        = pencil.contact_nodes.empty()
                                ? Eigen::Index(0)
                                : static_cast<Eigen::Index>(pencil.contact_nodes.back() + 1);
  mode.growth_by_friction   = Eigen::VectorXd::Zero(n_nodes);
  mode.motion_of_contact    = Eigen::VectorXd::Zero(n_nodes);
  const ComplexVector slip  = product(pencil.distribution.transpose(), found.u);
  for (std::size_t k = 0; k < pencil.contact_nodes.size(); ++k)
    {
      const auto node = static_cast<Eigen::Index>(pencil.contact_nodes[k]);
      const Complex u = slip[static_cast<Eigen::Index>(k)];
      mode.growth_by_friction[node] +=
        (std::conj(found.s * u) * force[static_cast<Eigen::Index>(k)]).real() / energy;
      mode.motion_of_contact[node] += std::norm(u);
    }
  return mode;
}
} // namespace

ComplexModes find_complex_modes(const SlidingPencil &pencil,
                                const double radius,
                                const ComplexModesOptions &options)
{
  const FeedingDrag drag = feeding_drag(pencil);
  SlidingLaw bounded     = pencil.law;
  if (pencil.on_springs())
    bounded.beta = 0.;
  const GrowthRegion region(bounded, radius, drag);
  ComplexModes result;
  result.radius              = radius;
  result.nothing_grows_above = region.highest_frequency();
  result.highest             = highest_vibration(pencil);

  const bool steep    = options.steep || !std::isfinite(pencil.largest_response());
  const double bottom = 2. * M_PI * options.lowest_frequency,
               top    = std::min(2. * M_PI * options.highest_frequency, result.highest);
  // Slightly larger than requested, so that the border of the count lies in a gap.
  constexpr double more = 0.02, counted = 0.3;
  const double wanted = -options.least_growth, most = wanted + 1e-3 * top,
               highest = top < result.highest ? (1. + more) * top : top,
               lowest  = (1. - more) * bottom;
  ComplexFactorization factors(pencil(Complex(1., top)));
  DiscSearch search(pencil, factors, options, result);
  const SlidingPencil still = without_friction(pencil);
  std::vector<Complex> vibrations; // without friction
  unsigned int seed = 0;
  // If there is nothing to count, searching far costs little.
  result.fastest_counted =
    steep ? counted * top
          : std::min(region.largest_width(highest), largest_growth(pencil, drag)) +
              1e-3 * top;
  // Modes that decay faster than they vibrate are not searched, nor heavily damped ones
  // for the count.
  SearchRange range{region, lowest, highest, most, 0., wanted > 0. ? 1. : 0.3};
  for (const double share : {0.1, 0.2, counted})
    {
      range.share = share;
      {
        const auto scope = optional_scope(options.timer, "Search");
        search.cover(range, ++seed);
      }
      if (!options.count || !(bottom < top))
        break;
      const auto scope = optional_scope(options.timer, "Count");
      if (seed == 1)
        {
          // Includes some vibrations beyond the border, near which the phase turns fast.
          constexpr double infinite = std::numeric_limits<double>::infinity();
          vibrations =
            find_still(still, {range.bottom, 1.5 * range.top, infinite, 0., range.steep},
                       options.tolerance);
          range.decay = search_for_count(range, vibrations, search);
        }
      CountedRange within =
        quiet_range(range, wanted, bottom, top, vibrations, search.found());
      within.right     = result.fastest_counted;
      result.n_missing = count_missing(pencil, still, factors, within, search.found(),
                                       vibrations, options, result);
      if (result.n_missing == 0)
        break;
    }

  // Growth rates of neutral modes are of the size of round-off, and so are rigid motions
  // that only dashpots resist.
  const double neutral = options.least_growth < 0. ? 0. : 100. * options.tolerance,
               allowed = std::max(1e-6, 100. * options.tolerance);
  const auto is_rigid  = [&](const ComplexMode &mode) {
    return std::abs(mode.s) < 1e-7 * top && !(mode.residual <= allowed);
  };
  for (const FoundMode &mode : search.found())
    if (mode.s.real() >= options.least_growth + neutral * std::abs(mode.s) &&
        mode.s.imag() >= bottom && mode.s.imag() <= top && mode.s.imag() > -mode.s.real())
      if (const ComplexMode done = finish(pencil, mode); !is_rigid(done))
        result.modes.push_back(done);
  std::sort(
    result.modes.begin(), result.modes.end(),
    [](const ComplexMode &a, const ComplexMode &b) { return a.s.real() > b.s.real(); });
  for (const ComplexMode &mode : result.modes)
    if (!(mode.residual <= allowed))
      throw NotConverged(brief_text(4, "the Arnoldi iteration left a mode at ",
                                    mode.frequency(), " Hz with a relative residual of ",
                                    mode.residual));
  return result;
}
} // namespace mesoslip
