#include "eigenvalues/complex/complex_modes.h"

#include "eigenvalues/complex/disc_search.h"
#include "eigenvalues/complex/mode_count.h"
#include "material/plausibility.h"
#include "statics/static_solver.h"

#include <algorithm>
#include <cmath>

namespace mesoslip
{
namespace
{
using Complex = SlidingPencil::Complex;

/**
 * The decay up to which is searched: a little more than asked for, where no eigenvalue that
 * is @p found is near the border.
 */
double
quiet_decay(const double wanted, const double most, const std::vector<FoundMode> &found)
{
  double best = most, distance = 0.;
  for (unsigned int k = 1; k <= 8; ++k)
    {
      const double decay = wanted + (most - wanted) * (k / 8.);
      double nearest     = most;
      for (const FoundMode &mode : found)
        nearest = std::min(nearest, std::fabs(mode.s.real() + decay));
      if (nearest > distance)
        {
          distance = nearest;
          best     = decay;
        }
    }
  return best;
}

/** Residual, and who feeds the mode: Re(v^H f) over v^H M v + u^H K u. */
ComplexMode finish(const SlidingPencil &pencil, const FoundMode &found)
{
  ComplexMode mode;
  mode.s        = found.s;
  mode.shape    = found.u;
  mode.residual = pencil.residual(found.s, found.u);

  const Eigen::VectorXd real = found.u.real(), imaginary = found.u.imag();
  const double elastic = real.dot(pencil.stiffness * real) +
                         imaginary.dot(pencil.stiffness * imaginary),
               speed = std::norm(found.s),
               energy =
                 speed * found.u.dot(pencil.mass.cwiseProduct(found.u)).real() + elastic;
  mode.growth_by_damping    = -pencil.law.beta * speed * elastic / energy;
  const ComplexVector force = pencil.friction_force(found.s, found.u);
  const auto n_nodes        = pencil.contact_nodes.empty()
                                ? Eigen::Index(0)
                                : static_cast<Eigen::Index>(pencil.contact_nodes.back() + 1);
  mode.growth_by_friction   = Eigen::VectorXd::Zero(n_nodes);
  mode.motion_of_contact    = Eigen::VectorXd::Zero(n_nodes);
  for (std::size_t k = 0; k < pencil.rows.size(); ++k)
    {
      const auto node = static_cast<Eigen::Index>(pencil.contact_nodes[k]);
      const Complex u = found.u[pencil.rows[k]];
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
  const GrowthRegion region(pencil.law, radius, feeding_drag(pencil));
  ComplexModes result;
  result.radius              = radius;
  result.nothing_grows_above = region.highest_frequency();

  const double bottom = 2. * M_PI * options.lowest_frequency,
               top    = 2. * M_PI * options.highest_frequency;
  const double wanted = -options.least_growth, most = wanted + 1e-3 * top;
  ComplexFactorization factors(pencil(Complex(1., top)));
  DiscSearch search(pencil, factors, options, result);
  constexpr double counted = 0.3;
  unsigned int seed        = 0;
  result.fastest_counted =
    SearchRange{region, bottom, top, most, counted}.right(bottom, top);
  for (const double share : {0.1, 0.2, counted})
    {
      search.cover({region, bottom, top, most, share}, ++seed);
      if (!options.count)
        break;
      result.n_missing = count_missing(
        pencil, factors,
        {region, bottom, top, quiet_decay(wanted, most, search.found()), counted},
        search.found(), options, result);
      if (result.n_missing == 0)
        break;
    }

  // Neutral modes have growth rates of the size of round-off.
  const double neutral = options.least_growth < 0. ? 0. : 100. * options.tolerance;
  for (const FoundMode &mode : search.found())
    if (mode.s.real() >= options.least_growth + neutral * std::abs(mode.s) &&
        mode.s.imag() >= bottom && mode.s.imag() <= top && mode.s.imag() > -mode.s.real())
      result.modes.push_back(finish(pencil, mode));
  std::sort(
    result.modes.begin(), result.modes.end(),
    [](const ComplexMode &a, const ComplexMode &b) { return a.s.real() > b.s.real(); });
  for (const ComplexMode &mode : result.modes)
    if (!(mode.residual <= std::max(1e-6, 100. * options.tolerance)))
      throw NotConverged(brief_text(4, "the Arnoldi iteration left a mode at ",
                                    mode.frequency(), " Hz with a relative residual of ",
                                    mode.residual));
  return result;
}
} // namespace mesoslip
