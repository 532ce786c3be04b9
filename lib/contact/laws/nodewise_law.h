#ifndef mesoslip_contact_laws_nodewise_law_h
#define mesoslip_contact_laws_nodewise_law_h

#include "contact/laws/coefficient_law.h"

#include <cmath>

namespace mesoslip
{
/**
 * Slip rate V from 0 to @p free_rate with V + softness mu(V) = free_rate, by Newton's
 * method within an interval that always contains a solution; 0 if softness mu(0) alone
 * stops the node. The solution is unique if softness |d mu/d V| < 1 where mu falls;
 * otherwise a sliding node gets a solution with which it continues to slide. @p at has
 * all arguments of mu; its slip rate is the initial guess.
 */
template <class Law>
double solve_slip_rate(const Law &law,
                       SlipPoint at,
                       const double free_rate,
                       const double softness)
{
  constexpr double close   = 1e-7; // Newton's method squares this error in the next step
  constexpr int most_steps = 200;
  const auto excess        = [&](const double rate) {
    at.slip_rate = rate;
    return rate + softness * law.coefficient(at) - free_rate;
  };
  double rate = at.slip_rate, lower = 0., upper = free_rate;
  if (!(free_rate > 0.))
    return 0.;
  bool knows_rest = false;
  if (!(rate > 0.))
    {
      if (excess(0.) >= 0.)
        return 0.;
      knows_rest = true;
    }
  if (!(rate > 0. && rate <= upper))
    rate = upper;
  for (int n = 0; n < most_steps; ++n)
    {
      const double error           = excess(rate);
      (error > 0. ? upper : lower) = rate;
      const double next            = rate - error / (1. + softness * law.slope(at));
      const bool arrives           = std::fabs(next - rate) <= close * rate;
      if (arrives || (next > lower && next < upper))
        rate = next;
      else if (lower == 0. && !knows_rest)
        {
          if (excess(0.) >= 0.)
            return 0.;
          knows_rest = true;
          rate       = 1e-3 * upper;
        }
      else // rates may differ by decades
        rate = lower > 0. ? std::sqrt(lower * upper) : 1e-3 * upper;
      if (arrives)
        break;
    }
  return rate;
}

/**
 * Base class of laws whose functions are inlined into the loop over the nodes. Nothing is
 * solved if mu does not depend on the slip rate.
 */
template <class Law, bool depends_on_rate = true>
class NodewiseLaw : public CoefficientLaw
{
public:
  /** See CoefficientLaw; calls no functions of the law through pointers. */
  void update(const SlipNodes &nodes) const final
  {
    const Law &law = static_cast<const Law &>(*this);
    for (std::size_t i = 0; i < nodes.n; ++i)
      {
        if (nodes.state != nullptr)
          nodes.state[i] = law.next_state(nodes.state[i], nodes.before[i]);
        if (nodes.softness[i] < 0.)
          continue;
        SlipPoint at;
        at.slip_rate = nodes.before[i].slip_rate;
        at.time      = nodes.time;
        if (nodes.state != nullptr)
          at.state = nodes.state[i];
        if (nodes.pressure != nullptr)
          at.pressure = nodes.pressure[i];
        for (unsigned int d = 0; d < 2; ++d)
          if (nodes.position[d] != nullptr)
            at.position[d] = nodes.position[d][i];
        if constexpr (depends_on_rate)
          at.slip_rate = solve_slip_rate(law, at, nodes.free_rate[i], nodes.softness[i]);
        nodes.coefficient[i] = law.coefficient(at);
      }
  }
};
} // namespace mesoslip

#endif
