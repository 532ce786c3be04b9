#include "contact_testing.h"

#include <gtest/gtest.h>
#include <stdexcept>

using namespace contact_testing;

namespace
{
constexpr double block_mu   = 0.25;
constexpr double block_mass = 0.03;
} // namespace

TEST(Block, ThrownOnAPlane)
{
  // The v^2 / (2 mu g) of the text book; the last step is one of sticking.
  const double g = 9.81, v = 3., dt = 1e-4;
  for (const double b : {0.5, 0.8})
    for (const double sign : {1., -1.})
      {
        ContactSetup setup = contact_setup(1, block_mu, 0., 0.);
        Points block(setup, step_of(dt, b), {block_mass});
        block.load(0, 0., block_mass * g);
        block.w.row(0, 0)[0] = sign * (v + b * dt * block_mu * g);
        const double stop    = v / (block_mu * g);
        while (block.time() < 1.2 * stop)
          block.advance();
        const auto &h = block.history();
        for (unsigned int n = 0; h.time[n] < 0.999 * stop; ++n)
          ASSERT_NEAR(h.nodes[0].vx[n], sign * (v - block_mu * g * h.time[n]), 1e-11);
        EXPECT_NEAR(block.u.row(0, 0)[0], sign * v * v / (2. * block_mu * g), 2e-8);
        EXPECT_NEAR(h.nodes[0].vx.back(), 0., 1e-13);
        EXPECT_EQ(h.sticking.back(), 1.);
        // All the energy goes into friction but for what the last step of b > 1/2 takes.
        EXPECT_NEAR(block.contact.work().friction, 0.5 * block_mass * v * v,
                    2e-4 * block_mass * v * v);
        EXPECT_EQ(block.contact.work().external, 0.);
      }
}

TEST(Block, FollowsAFlatThatReverses)
{
  const double g = 9.81, V = 2., dt = 1e-4;
  ContactSetup setup  = contact_setup(1, block_mu, 0., 0.);
  setup.flat_velocity = LoadHistory(V, "if(t < 0.49995, 2, -2)");
  Points block(setup, step_of(dt), {block_mass});
  block.load(0, 0., block_mass * g);
  block.w.row(0, 0)[0] = V;
  while (block.time() < 2.5)
    block.advance();
  const auto &h        = block.history();
  const double slipped = 2. * V / (block_mu * g);
  for (unsigned int n = 0; n < h.time.size(); ++n)
    {
      const double t        = h.time[n] - 0.5;
      const double expected = t < 0. ? V : t < slipped ? V - block_mu * g * t : -V;
      ASSERT_NEAR(h.nodes[0].vx[n], expected, 1.1 * block_mu * g * dt);
    }
  // The flat slides 2 V t - mu g t^2 / 2 under the block; in the step of its jump it rests in the mean.
  EXPECT_NEAR(block.contact.work().friction,
              block_mu * block_mass * g * V * (slipped - dt), 1e-10);
}

TEST(ContactPoint, TractionsOfEndNodes)
{
  // Half the width: half the mass and half the forces. All loads change.
  Points points(contact_setup(3, block_mu, 0.02, 4e-8), step_of(1e-8),
                {block_mass / 2, block_mass, block_mass / 2});
  double largest = 0.;
  for (unsigned int n = 0; n < 3000; ++n)
    {
      const double N = 300. * std::sin(0.01 * n) + 100., T = 90. * std::cos(0.017 * n);
      points.load(0, T / 2, N / 2);
      points.load(1, T, N);
      points.load(2, T / 2, N / 2);
      points.advance();
      for (const unsigned int end : {0u, 2u})
        {
          ASSERT_EQ(2. * points.friction(end), points.friction(1));
          ASSERT_EQ(2. * points.pressing(end), points.pressing(1));
          ASSERT_EQ(points.u.row(0, 0)[end], points.u.row(0, 0)[1]);
        }
      largest = std::max(largest, points.friction(1));
    }
  const NodeCounts counts = points.counts();
  EXPECT_GT(counts.stick[1], 0.f);
  EXPECT_GT(counts.slip[1], 0.f);
  EXPECT_LT(counts.stick[1] + counts.slip[1], 3000.f);
  EXPECT_GT(largest, 1.);
}

TEST(LoadHistory, Ramps)
{
  const LoadHistory step(3.), linear(3., Ramp::linear, 2.), smooth(3., Ramp::smooth, 2.);
  const LoadHistory typed(3., "3*cos(2*pi*t) + 1");
  EXPECT_EQ(step(0.), 3.);
  EXPECT_EQ(linear(0.), 0.);
  EXPECT_EQ(linear(0.5), 0.75);
  EXPECT_EQ(linear(5.), 3.);
  EXPECT_EQ(smooth(0.), 0.);
  EXPECT_NEAR(smooth(0.5), 1.5 * (1. - std::sqrt(0.5)), 1e-15);
  EXPECT_NEAR(smooth(1.), 1.5, 1e-15);
  EXPECT_EQ(smooth(2.), 3.);
  EXPECT_NEAR(typed(1. / 6.), 2.5, 1e-14);
  EXPECT_EQ(typed.amplitude(), 3.);
  EXPECT_THROW(LoadHistory(1., "3*("), std::invalid_argument);
  EXPECT_THROW(LoadHistory(1., "3*x"), std::invalid_argument);
}

// The parser takes the last item of a list: 2,5 would be 5.
TEST(LoadHistory, DecimalCommasAreNoNumbers)
{
  for (const std::string text :
       {"2,5", "0,5e6", "2,5*t", "(2,5)*t", "2 , 5", "sin(2*t), 5", "if((0,5) > t, 1, 0)",
        ",5", "min(0,5, t)", "max(t,0,5)", "min(sin(t), 2*(t + 0,5))", "sqrt(2,5)",
        "if(t < 1, 0,5, 1)", "if(t > 0,5, 1, 2)", "pi(0,5)", "avg (0,5, t)"})
    EXPECT_THROW(LoadHistory(1., text), std::invalid_argument) << text;
  EXPECT_EQ(LoadHistory(1., "min(0.5, t)")(2.), 0.5);
  EXPECT_EQ(LoadHistory(1., "max(t, 3, 2)")(1.), 3.);
  EXPECT_EQ(LoadHistory(1., "if(t<1,0,5)")(2.), 5.);
  EXPECT_EQ(LoadHistory(1., "if(t < 1, (2 + 1)*min(t, 2), 5)")(0.5), 1.5);
  EXPECT_NEAR(LoadHistory(1., "atan2(1, t)")(1.), std::atan2(1., 1.), 1e-15);
}
