// Laws of the coefficient of friction: their formulas.

#include "contact/laws/friction_expression.h"
#include "contact/laws/friction_table.h"
#include "contact/laws/slip_weakening.h"
#include "contact_law_testing.h"

#include <gtest/gtest.h>
#include <stdexcept>

using namespace contact_testing;

namespace
{
/** Slope by a central difference. */
double difference(const CoefficientLaw &law, SlipPoint at)
{
  const double h = 1e-5 * at.slip_rate;
  at.slip_rate += h;
  const double above = law.coefficient(at);
  at.slip_rate -= 2. * h;
  return (above - law.coefficient(at)) / (2. * h);
}

} // namespace

// Numbers of numpy, from the formulas.
TEST(CoefficientLaw, Formulas)
{
  const Stribeck exponential(stribeck_constants());
  EXPECT_EQ(exponential.coefficient(at_rate(0.)), 0.6);
  EXPECT_NEAR(exponential.coefficient(at_rate(0.5)), 0.48381535712974755, 1e-15);
  const Stribeck curve({0.6, 0.35, 0.8, 2.5, 0.01});
  EXPECT_NEAR(curve.coefficient(at_rate(0.5)), 0.5385789352979218, 1e-15);
  for (const double reach : {0.3, 1., 3.})
    {
      SlipWeakening::Constants c{0.5, 0.1, 2e-3, false, {}};
      EXPECT_NEAR(SlipWeakening(c).coefficient(at_rate(1., reach * 2e-3)),
                  reach < 1. ? 0.5 - 0.4 * reach : 0.1, 1e-15);
      c.exponential = true;
      EXPECT_NEAR(SlipWeakening(c).coefficient(at_rate(1., reach * 2e-3)),
                  0.1 + 0.4 * std::exp(-reach), 1e-15);
    }
  // Far above V_0 the regularized law is f_0 + a ln(V / V_0) + b ln(V_0 theta / L).
  const RateAndState::Constants c = rate_and_state_constants(true);
  const RateAndState state(c);
  EXPECT_NEAR(state.coefficient(at_rate(0.2, 0.05)),
              0.6 + 0.02 * std::log(0.2 / 1e-3) + 0.03 * std::log(1e-3 * 0.05 / 2e-3),
              1e-13);
  EXPECT_EQ(state.coefficient(at_rate(0., 0.05)), 0.);
  EXPECT_EQ(
    RateAndState({0.6, 1e-4, 0., 2e-3, 1e-3, 0.5, true}).coefficient(at_rate(0., 1.)),
    0.);                                   // exp(6000) is beyond all numbers
  const double tiny = 1e-20, theta = 0.05; // asinh(x) = x
  EXPECT_NEAR(state.coefficient(at_rate(tiny, theta)) /
                (0.02 * tiny / 2e-3 *
                 std::exp((0.6 + 0.03 * std::log(1e-3 * theta / 2e-3)) / 0.02)),
              1., 1e-7);
}

TEST(CoefficientLaw, SlopesAndTheirBounds)
{
  const Stribeck curve({0.6, 0.35, 0.8, 2.5, 0.01}), plain(stribeck_constants());
  const RateAndState state(rate_and_state_constants(true));
  const FrictionTable table({{0., 1., 3.}, {0.}, {0.6, 0.5, 0.1}});
  const FrictionExpression expression("0.3 + 0.2*exp(-V^2)", 2, {});
  for (const double V : {1e-3, 0.1, 0.5, 0.9, 2., 2.7})
    for (const CoefficientLaw *law : std::initializer_list<const CoefficientLaw *>{
           &curve, &plain, &state, &table, &expression})
      EXPECT_NEAR(law->slope(at_rate(V, 0.3)), difference(*law, at_rate(V, 0.3)),
                  2e-5 * std::fabs(law->slope(at_rate(V, 0.3))) + 1e-7);
  for (const Stribeck *law : {&curve, &plain})
    {
      double steepest = 0.;
      for (int k = 0; k < 4000; ++k)
        steepest = std::max(steepest, -law->slope(at_rate(1e-3 * k)));
      EXPECT_NEAR(law->steepest_fall(), steepest, 1e-5 * steepest);
    }
  EXPECT_NEAR(table.steepest_fall(), 0.2, 1e-15);
  EXPECT_EQ(table.largest(10.), 0.6);
  EXPECT_NEAR(curve.largest(10.), 0.7, 1e-15);
}

TEST(CoefficientLaw, TableIsBilinearAndConstantBeyondItsEnds)
{
  const FrictionTable table({{0.1, 1., 4.}, {1e6, 3e6}, {0.6, 0.5, 0.4, 0.3, 0.2, 0.1}});
  EXPECT_NEAR(table.coefficient(at_rate(1., 0., 1e6)), 0.4, 1e-15);
  EXPECT_NEAR(table.coefficient(at_rate(2.5, 0., 2e6)), 0.25, 1e-15);
  EXPECT_NEAR(table.coefficient(at_rate(0.55, 0., 1.5e6)), 0.475, 1e-15);
  EXPECT_NEAR(table.coefficient(at_rate(0., 0., 0.)), 0.6, 1e-15);
  EXPECT_NEAR(table.coefficient(at_rate(9., 0., 9e6)), 0.1, 1e-15);
  EXPECT_TRUE(table.looks_around());
  EXPECT_FALSE(FrictionTable({{0.}, {0.}, {0.3}}).looks_around());
  EXPECT_EQ(FrictionTable({{0.}, {0.}, {0.3}}).coefficient(at_rate(2.)), 0.3);
}

TEST(CoefficientLaw, ExpressionsInAllVariables)
{
  SlipPoint at = at_rate(2., 1e-3, 5e6);
  at.time      = 0.25;
  at.position  = {{0.01, 0.02}};
  EXPECT_NEAR(FrictionExpression("0.1*V + 10*D + p/1e8 + t + x", 2, {}).coefficient(at),
              0.2 + 0.01 + 0.05 + 0.25 + 0.01, 1e-15);
  EXPECT_NEAR(FrictionExpression("if(y > 0.01, 0.3, 0.2)", 3, {}).coefficient(at), 0.3,
              0.);
  EXPECT_FALSE(FrictionExpression("0.3/(1 + V)", 2, {}).looks_around());
  EXPECT_FALSE(FrictionExpression("0.3/(1 + V)", 2, {}).state());
  EXPECT_TRUE(FrictionExpression("0.3/(1 + D)", 2, {}).state());
  EXPECT_TRUE(std::isnan(FrictionExpression("0.3 - V", 2, {}).coefficient(at)));
  for (const char *text : {"0.3 + y", "0,3", "V = 3", "rand()", "0.3*(", "u", ""})
    EXPECT_THROW(FrictionExpression(text, 2, {}), std::invalid_argument) << text;
}
