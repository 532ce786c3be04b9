#ifndef mesoslip_contact_laws_slip_weakening_h
#define mesoslip_contact_laws_slip_weakening_h

#include "contact/laws/healing.h"
#include "contact/laws/nodewise_law.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mesoslip
{
/**
 * A coefficient that depends on the accumulated slip D of a node,
 *
 *     mu = mu_k + (mu_s - mu_k) max(0, 1 - D / D_c)    linear (Ida 1972, Andrews 1976)
 *     mu = mu_k + (mu_s - mu_k) exp(-D / D_c)          exponential
 */
class SlipWeakening final : public NodewiseLaw<SlipWeakening, false>
{
public:
  /** Constants of the law. */
  struct Constants
  {
    double at_rest       = 0.;    ///< mu_s
    double kinetic       = 0.;    ///< mu_k; above mu_s friction rises with D
    double critical_slip = 1.;    ///< D_c > 0 (m)
    bool exponential     = false; ///< exponential; else linear
    Healing healing;              ///< reset of D
  };

  /** Uses @p constants. */
  explicit SlipWeakening(const Constants &constants)
    : c(constants)
  {
  }

  double coefficient(const SlipPoint &at) const override
  {
    const double x    = at.state / c.critical_slip,
                 rest = c.exponential ? std::exp(-x) : std::max(0., 1. - x);
    return c.kinetic + (c.at_rest - c.kinetic) * rest;
  }

  double slope(const SlipPoint &) const override
  {
    return 0.;
  }

  std::optional<StateVariable> state() const override
  {
    return StateVariable{"slip", "m", 0.};
  }

  double next_state(const double state, const SlipStep &step) const override
  {
    return c.healing.next_slip(state, step);
  }

  double steady_state(const double slip_rate) const override
  {
    return slip_rate > 0. ? std::numeric_limits<double>::infinity() : 0.;
  }

  double largest(const double) const override
  {
    return std::max(c.at_rest, c.kinetic);
  }

  double steepest_fall_in_slip() const override
  {
    return std::max(0., c.at_rest - c.kinetic) / c.critical_slip;
  }

private:
  const Constants c;
};
} // namespace mesoslip

#endif
