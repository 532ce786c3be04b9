// Laws of the coefficient of friction: point masses with exact motions.

#include "../../measured.h"
#include "contact/laws/friction_expression.h"
#include "contact/laws/slip_weakening.h"
#include "contact_law_testing.h"

#include <functional>
#include <gtest/gtest.h>
#include <limits>

using namespace contact_testing;

namespace
{
constexpr double law_mass = 0.03, gravity = 9.81;

template <class Law>
ContactSetup
setup_with(const Law &law, const double reference, const double flat_velocity)
{
  ContactSetup setup        = contact_setup(1, reference, flat_velocity, 0.);
  setup.law.coefficient_law = std::make_shared<Law>(law);
  setup.law.reference       = reference;
  return setup;
}

/** A block with weight that is thrown with @p velocity; @p rate is its deceleration then. */
Points thrown(const ContactSetup &setup,
              const double dt,
              const double velocity,
              const double rate,
              const double beta2 = 0.5)
{
  Points block(setup, step_of(dt, beta2), {law_mass});
  block.load(0, 0., law_mass * gravity);
  block.w.row(0, 0)[0] = velocity + beta2 * dt * rate;
  return block;
}

/** That errors of three step lengths, each half of the one before, fall with order two. */
void expect_order_two(const std::function<double(double)> &error, const double dt)
{
  double last = 0.;
  for (const double h : {dt, 0.5 * dt, 0.25 * dt})
    {
      const double found = error(h);
      ASSERT_TRUE(std::isfinite(found));
      if (last != 0.)
        {
          EXPECT_NEAR(std::log2(last / found), 2., 0.15)
            << "errors " << last << " " << found;
        }
      last = found;
    }
}
} // namespace

// y = exp(v / V_c) of a block that the law brakes obeys a linear equation.
TEST(CoefficientLaw, VelocityWeakeningIsOfOrderTwo)
{
  const Stribeck::Constants c = stribeck_constants();
  const double v0 = 3., ratio = (c.at_rest - c.kinetic) / c.kinetic;
  const double y0     = std::exp(v0 / c.critical_velocity);
  const auto velocity = [&](const double t) {
    return c.critical_velocity *
           std::log((y0 + ratio) *
                      std::exp(-gravity * c.kinetic * t / c.critical_velocity) -
                    ratio);
  };
  expect_order_two(
    [&](const double dt) {
      Points block = thrown(setup_with(Stribeck(c), c.at_rest, 0.), dt, v0,
                            gravity * Stribeck(c).coefficient(at_rate(v0)));
      for (int n = 0; n <= std::lround(0.6 / dt); ++n)
        block.advance();
      const auto &h = block.history();
      measured::error("velocity weakening: velocity of a block", 0.6 / dt,
                      std::fabs(h.nodes[0].vx.back() - velocity(h.time.back())));
      return std::fabs(h.nodes[0].vx.back() - velocity(h.time.back()));
    },
    2e-2);
}

TEST(CoefficientLaw, SlipWeakeningTurnsKineticEnergyIntoWork)
{
  for (const bool exponential : {false, true})
    {
      const SlipWeakening::Constants c{0.5, 0.1, exponential ? 0.3 : 2., exponential, {}};
      const double v0 = 3.;
      expect_order_two(
        [&](const double dt) {
          Points block = thrown(setup_with(SlipWeakening(c), c.at_rest, 0.), dt, v0,
                                gravity * c.at_rest);
          for (int n = 0; n <= std::lround(0.4 / dt); ++n)
            block.advance();
          const auto &h  = block.history();
          const double D = h.nodes[0].ux.back(), x = D / c.critical_slip;
          const double weakened = exponential ? 1. - std::exp(-x) : x - 0.5 * x * x;
          const double square =
            v0 * v0 -
            2. * gravity *
              (c.kinetic * D + (c.at_rest - c.kinetic) * c.critical_slip * weakened);
          EXPECT_NEAR(block.contact.law_state()[0], D, 1e-12);
          return std::fabs(std::sqrt(square) - h.nodes[0].vx.back());
        },
        1.25e-2);
    }
}

// A held node on a flat that changes its speed: mu jumps by a ln(V_2 / V_1) and falls by
// b ln(V_2 / V_1) over the slip length.
TEST(CoefficientLaw, RateAndStateAfterAStepOfVelocity)
{
  const double V1 = 0.2, V2 = 1., dt = 1e-5, jump = 0.2;
  for (const bool aging : {false, true})
    {
      const RateAndState::Constants c = rate_and_state_constants(aging);
      ContactSetup setup              = setup_with(RateAndState(c), c.reference, V1);
      setup.flat_velocity             = LoadHistory(V1, "if(t < 0.199995, 0.2, 1)");
      Points point(setup, step_of(dt), {law_mass});
      point.hold_x(0);
      point.load(0, 0., 100.);
      double before = 0.;
      while (point.time() < jump - 0.5 * dt)
        {
          point.advance();
          before = point.friction() / point.pressing();
        }
      EXPECT_NEAR(before, c.reference + (c.a - c.b) * std::log(V1 / c.velocity), 1e-7);
      point.advance(); // the flat has the mean of both speeds
      EXPECT_NEAR(point.friction() / point.pressing(),
                  before + c.a * std::log(0.5 * (V1 + V2) / V1), 1e-6);
      for (int n = 1; n < 2000; ++n)
        {
          point.advance();
          const double slip = V2 * n * dt, decay = std::exp(-slip / c.length);
          const double state =
            aging ? std::log1p((V2 / V1 - 1.) * decay) : std::log(V2 / V1) * decay;
          ASSERT_NEAR(point.friction() / point.pressing(),
                      before + c.a * std::log(V2 / V1) - c.b * std::log(V2 / V1) +
                        c.b * state,
                      2e-7)
            << n;
        }
    }
}

// Against Runge and Kutta's method with steps of a hundredth.
TEST(CoefficientLaw, RateAndStateIsOfOrderTwo)
{
  for (const bool aging : {false, true})
    {
      const RateAndState::Constants c = rate_and_state_constants(aging);
      const RateAndState law(c);
      const double v0 = 1., theta0 = c.initial_state, end = 0.1;
      using State      = std::array<double, 2>;
      const auto rates = [&](const State &y) {
        const double x = y[0] * y[1] / c.length;
        return State{
          {-gravity * c.a *
             std::asinh(
               y[0] / (2. * c.velocity) *
               std::exp((c.reference + c.b * std::log(c.velocity * y[1] / c.length)) /
                        c.a)),
           aging ? 1. - x : -x * std::log(x)}};
      };
      State y{{v0, theta0}};
      const int steps = 400000;
      const double h  = end / steps;
      const auto plus = [](const State &a, const double s, const State &b) {
        return State{{a[0] + s * b[0], a[1] + s * b[1]}};
      };
      for (int n = 0; n < steps; ++n)
        {
          const State k1 = rates(y), k2 = rates(plus(y, 0.5 * h, k1)),
                      k3 = rates(plus(y, 0.5 * h, k2)), k4 = rates(plus(y, h, k3));
          y = plus(plus(plus(plus(y, h / 6., k1), h / 3., k2), h / 3., k3), h / 6., k4);
        }
      expect_order_two(
        [&](const double dt) {
          Points block = thrown(setup_with(law, c.reference, 0.), dt, v0,
                                gravity * law.coefficient(at_rate(v0, theta0)));
          const int n  = static_cast<int>(std::lround(end / dt));
          for (int k = 0; k <= n; ++k)
            block.advance();
          return std::fabs(block.history().nodes[0].vx.back() - y[0]);
        },
        1e-4);
    }
}

// What the kernel made of the coefficient is the law at the velocity of the same instant.
TEST(CoefficientLaw, ForceAndSlipRateBelongTogether)
{
  const Stribeck law(stribeck_constants());
  Points block =
    thrown(setup_with(law, 0.6, 0.5), 2e-3, 3., gravity * law.coefficient(at_rate(2.5)));
  for (int n = 0; n < 200; ++n)
    {
      block.advance();
      const double V = block.history().nodes[0].vx.back() - 0.5;
      ASSERT_NEAR(block.friction(), -law.coefficient(at_rate(V)) * block.pressing(),
                  1e-12);
    }
  // Twice the coefficient of the law, as of a node in another phase.
  ContactSetup setup         = setup_with(law, 0.6, 0.5);
  setup.friction_coefficient = {1.2};
  Points other               = thrown(setup, 2e-3, 3., 0.);
  other.advance();
  other.advance();
  const double V = other.history().nodes[0].vx.back() - 0.5;
  EXPECT_NEAR(other.friction(), -2. * law.coefficient(at_rate(V)) * other.pressing(),
              1e-12);
}

// A block on a spring of which the other end moves: sticks up to mu_s, slips by twice the
// drop of force (Bowden and Leben 1939) when the kinetic coefficient is reached at once.
TEST(CoefficientLaw, SpringAndBlockStickAndSlip)
{
  const double k = 50., pulling = 1e-3, dt = 1e-4, N = law_mass * gravity;
  const Stribeck law({0.6, 0.4, 0.002, 1., 0.});
  Points block(setup_with(law, 0.6, 0.), step_of(dt), {law_mass});
  double largest = 0., least = 1.;
  for (int n = 0; n < 100000; ++n)
    {
      const double force = k * (pulling * n * dt - block.u.row(0, 0)[0]);
      block.load(0, force, N);
      block.advance();
      largest = std::max(largest, force / N);
      if (n > 50000)
        least = std::min(least, force / N);
    }
  EXPECT_NEAR(largest, 0.6, 1e-3);
  EXPECT_NEAR(least, 0.4 - (0.6 - 0.4), 1.5e-2);
  const NodeCounts counts = block.counts();
  EXPECT_GT(counts.stick[0], 5. * counts.slip[0]);
  EXPECT_LT(block.contact.variable_friction()->largest_weakening(), 1.);
}

TEST(CoefficientLaw, SlipIsForgottenAsHealingSays)
{
  using Kind = Healing::Kind;
  const SlipStep slips{0.1, 2., true, false}, sticks{0.1, 0., true, true},
    flies{0.1, 2., false, false};
  for (const Kind kind : {Kind::none, Kind::separation, Kind::sticking, Kind::time})
    {
      const Healing healing{kind, 0.05};
      EXPECT_NEAR(healing.next_slip(1., slips), 1.2, 1e-15);
      const double fading = std::exp(-2.);
      EXPECT_NEAR(healing.next_slip(1., sticks),
                  kind == Kind::sticking ? 0.
                  : kind == Kind::time   ? fading
                                         : 1.,
                  1e-15);
      EXPECT_NEAR(healing.next_slip(1., flies),
                  kind == Kind::none   ? 1.
                  : kind == Kind::time ? fading
                                       : 0.,
                  1e-15);
    }
}

TEST(CoefficientLaw, StateBeginsAnewOffTheFlat)
{
  const RateAndState::Constants c = rate_and_state_constants(true);
  Points point(setup_with(RateAndState(c), c.reference, 1.), step_of(1e-4), {law_mass});
  point.hold_x(0);
  point.load(0, 0., 100.);
  for (int n = 0; n < 200; ++n)
    point.advance();
  EXPECT_NEAR(point.contact.law_state()[0], c.length, 1e-4);
  point.load(0, 0., -100.);
  point.advance();
  point.advance();
  EXPECT_EQ(point.friction(), 0.);
  EXPECT_EQ(point.contact.law_state()[0], c.initial_state);
}

TEST(NormalStressMemory, RelaxesAfterAStepOfTheNormalForce)
{
  const double time = 2e-3, dt = 1e-4, mu = 0.3, N0 = 400., N1 = 1000.;
  for (const bool by_length : {false, true})
    {
      ContactSetup setup      = contact_setup(1, mu, 2., 0.);
      setup.law.normal_stress = by_length ? NormalStressMemory{0., 2.5 * time, 0.5}
                                          : NormalStressMemory{time, 0., 0.};
      Points point(setup, step_of(dt), {law_mass});
      point.hold_x(0);
      // A force that rises linearly in one step.
      const auto rise = [&](const int n) {
        return 1. + time / dt * std::expm1(-dt / time) * std::exp(-n * dt / time);
      };
      // In the first step there is no slip yet by which a length could be measured: the
      // flat moves from the start.
      point.load(0, 0., N0);
      for (int n = 0; n < 400; ++n)
        {
          point.advance();
          ASSERT_NEAR(point.friction(), mu * N0 * rise(n), 1e-9) << n << by_length;
          ASSERT_NEAR(point.pressing(), N0, 1e-9);
        }
      point.load(0, 0., N1);
      for (int n = 0; n < 100; ++n)
        {
          point.advance();
          ASSERT_NEAR(point.friction(), mu * (N0 + (N1 - N0) * rise(n)), 1e-6);
        }
      EXPECT_EQ(point.contact.law_state(), nullptr);
      ASSERT_NE(point.contact.variable_friction()->remembered_normal_force(), nullptr);
      point.load(0, 0., -N1);
      point.advance();
      EXPECT_EQ(point.contact.variable_friction()->remembered_normal_force()[0], 0.);
    }
}

TEST(CoefficientLaw, NotANumberNeverPasses)
{
  ContactSetup setup = contact_setup(1, 1., 2., 0.);
  setup.law.coefficient_law =
    std::make_shared<FrictionExpression>("0.3 - V", 2, Healing());
  Points point(setup, step_of(1e-4), {law_mass});
  point.load(0, 0., 100.);
  point.advance();
  EXPECT_TRUE(std::isnan(point.friction()) || std::isnan(point.w.row(0, 0)[0]));
}
