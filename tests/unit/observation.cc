#include "observation/contact_statistics.h"
#include "observation/spectrum.h"

#include "base/errors.h"
#include "unit/material/material_testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace mesoslip;
using material_testing::pi;

namespace
{
std::vector<double> sampled(const std::size_t n,
                            const double time_step,
                            const std::function<double(const double)> &function)
{
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = function(static_cast<double>(i) * time_step);
  return values;
}

std::vector<double> times(const std::size_t n, const double time_step)
{
  return sampled(n, time_step, [](const double t) { return t; });
}

/** Work of a constant load of @p power. */
std::vector<double>
load_of(const double power, const std::size_t n, const double time_step)
{
  return sampled(n, time_step, [power](const double t) { return power * t; });
}

double friction_energy(const double t)
{
  return 1e4 * t + 0.05 * std::sin(2. * pi * 41321. * t);
}
} // namespace

TEST(Spectrum, OffBinSineRecoversFrequencyAndAmplitude)
{
  // 1 ms at 20 ns: bins of 1 kHz without padding.
  for (const double f : {40000., 41237.1, 39612.9, 41500.})
    {
      const auto signal  = sampled(50000, 2e-8, [f](const double t) {
        return 5e-6 + 3e-3 * t + 3.2e-6 * std::sin(2. * pi * f * t + 0.4);
      });
      const auto summary = summarize_spectrum(amplitude_spectrum(signal, 2e-8));
      ASSERT_TRUE(summary);
      EXPECT_NEAR(summary->main_frequency / f, 1., 1e-4);
      EXPECT_NEAR(summary->main_amplitude / 3.2e-6, 1., 2e-3);
    }
}

TEST(Spectrum, HighestFrequencyIsTheLastAboveTenPercent)
{
  const auto signal  = sampled(40000, 2.5e-8, [](const double t) {
    return 5. * std::sin(2. * pi * 600. * t) + std::sin(2. * pi * 4.1e4 * t) +
           0.15 * std::sin(2. * pi * 1.23e5 * t) + 0.07 * std::sin(2. * pi * 2.05e5 * t);
  });
  const auto summary = summarize_spectrum(amplitude_spectrum(signal, 2.5e-8));
  ASSERT_TRUE(summary);
  EXPECT_NEAR(summary->main_frequency, 4.1e4, 4.)
    << "peaks below 2 kHz do not count, of which 1 ms has two periods";
  EXPECT_GT(summary->slow_amplitude, 2.) << "0.6 periods, without their trend";
  EXPECT_NEAR(summary->highest_frequency, 1.23e5, 1e3);
}

TEST(Spectrum, SlowBodiesHaveAMainFrequencyToo)
{
  const auto signal  = sampled(20000, 1e-5, [](const double t) {
    return 1e-3 * std::sin(2. * pi * 269. * t) + 2e-4 * std::sin(2. * pi * 1100. * t);
  });
  const auto summary = summarize_spectrum(amplitude_spectrum(signal, 1e-5));
  ASSERT_TRUE(summary);
  EXPECT_NEAR(summary->main_frequency, 269., 0.1);
  EXPECT_LT(summary->slow_amplitude, 1e-5);
}

TEST(Spectrum, NoiseHardlyMovesThePeak)
{
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0., 0.5);
  const auto signal  = sampled(20000, 5e-8, [&](const double t) {
    return std::sin(2. * pi * 41234. * t) + noise(generator);
  });
  const auto summary = summarize_spectrum(amplitude_spectrum(signal, 5e-8));
  ASSERT_TRUE(summary);
  EXPECT_NEAR(summary->main_frequency / 41234., 1., 5e-4);
}

TEST(Spectrum, PowerNearTheHighestFrequency)
{
  // 500 kHz is the limit; 1.03 MHz is folded to 30 kHz and cannot be seen there, 0.53 MHz
  // to 470 kHz. Amplitudes 1 and 0.2: 4 % of the power.
  const auto share = [](const double f) {
    return share_near_limit(
      amplitude_spectrum(sampled(5000, 1e-6,
                                 [f](const double t) {
                                   return 7. + std::sin(2. * pi * 4.1e4 * t) +
                                          0.2 * std::sin(2. * pi * f * t);
                                 }),
                         1e-6));
  };
  EXPECT_LT(share(4.4e5), 1e-6);
  EXPECT_NEAR(share(4.7e5), 0.04 / 1.04, 1e-4);
  EXPECT_NEAR(share(5.3e5), 0.04 / 1.04, 1e-4);
  EXPECT_EQ(share_near_limit(Spectrum()), 0.);
}

TEST(Spectrum, WhatHasNoSpectrum)
{
  EXPECT_TRUE(amplitude_spectrum({1., 2., 3.}, 1e-6).frequency.empty());
  EXPECT_FALSE(
    summarize_spectrum(amplitude_spectrum(std::vector<double>(1000, 0.1), 1e-6)));
  EXPECT_FALSE(summarize_spectrum(amplitude_spectrum(times(1000, 1e-6), 1e-6)));
  std::vector<double> bad(100, 1.);
  bad[50] = std::nan("");
  EXPECT_THROW(amplitude_spectrum(bad, 1e-6), NumericalFailure);
}

TEST(Friction, SlopeOfALimitCycle)
{
  const double dt = 1e-7, period = 1. / 41321.;
  const auto energy = sampled(10001, dt, friction_energy);
  const auto mu     = interface_friction_coefficient(
        times(10001, dt), energy, load_of(5e4, 10001, dt), {2.5e-4, period});
  EXPECT_NEAR(mu.value, 0.2, 1e-4);
  EXPECT_LT(mu.half_width, 2e-4);
  EXPECT_EQ(mu.batches, 15u); // of two of the 30 whole periods
}

// Whole periods with a mean of their own, k/1000 in the k-th of 39, and a fraction before
// them: all 39 count for the value, the last 38 as 19 batches of two for its error.
TEST(Friction, AllWholePeriodsCount)
{
  const double period = 2e-5, dt = 1e-7, from = 0.6 * period, end = 39.6 * period;
  const auto power = [&](const double t) {
    const double k = std::floor((t - from) / period) + 1.;
    return 1e-3 * k + 0.1 * std::sin(2. * pi * (t - from) / period);
  };
  const auto values = sampled(7921, dt, [&](const double t) { return power(t + 1e-12); });
  const auto mean   = window_mean(times(7921, dt), values, {0., period});
  // Neighbouring periods share a sample of the trapezoidal rule: dt / period / 2 of a
  // step.
  EXPECT_NEAR(mean.value, 20e-3, 1e-3 * 0.5 * dt / period + 1e-12);
  EXPECT_EQ(mean.batches, 19u);
  EXPECT_NEAR(mean.begin, from, 1e-15);
  EXPECT_NEAR(mean.end, end, 1e-15);
  // 2.5, 4.5, ... 38.5: the deviation of 19 equidistant numbers, 2 apart.
  EXPECT_NEAR(mean.half_width, 2.10092 * 2e-3 * std::sqrt(20. / 12.), 1e-5);

  // The slope of a parabola is its rate in the middle of the window.
  const std::vector<std::pair<unsigned int, unsigned int>> batches = {
    {1, 1}, {19, 19}, {20, 20}, {21, 10}, {39, 19}, {41, 13}, {100, 20}};
  for (const auto &[periods, number] : batches)
    {
      const double to     = (periods + 0.4) * period;
      const std::size_t n = std::lround(to / dt) + 1;
      const auto energy   = sampled(n, dt, [](const double t) { return t * t; });
      const auto mu       = interface_friction_coefficient(times(n, dt), energy,
                                                           load_of(2., n, dt), {0., period});
      EXPECT_NEAR(mu.value, to - 0.5 * periods * period, 1e-9 * to) << periods;
      EXPECT_NEAR(mu.end - mu.begin, periods * period, 1e-12) << periods;
      EXPECT_EQ(mu.batches, number) << periods;
    }
}

// Friction that is 0.2 of a load which varies by itself: that variation is no error.
TEST(Friction, ALoadThatVaries)
{
  const double dt = 1e-7;
  const auto load = sampled(10001, dt, [](const double t) {
    return 3e4 * t + 4. * std::sin(2. * pi * 1300. * t);
  });
  auto friction   = load;
  for (double &value : friction)
    value *= 0.2;
  const auto mu =
    interface_friction_coefficient(times(10001, dt), friction, load, {9.5e-5, 2.5e-5});
  EXPECT_NEAR(mu.value, 0.2, 1e-12);
  EXPECT_EQ(mu.batches, 18u);
  EXPECT_LT(mu.half_width, 1e-12);
  EXPECT_GT(mean_power(times(10001, dt), friction, {9.5e-5, 2.5e-5}).half_width, 500.);
}

// A power that fluctuates at random: 95 % of the intervals have to cover the truth.
TEST(Friction, ConfidenceIntervalCovers)
{
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.2, 0.3);
  const double dt = 1e-7;
  int covered = 0, covered_mean = 0;
  const int trials = 400;
  for (int trial = 0; trial < trials; ++trial)
    {
      std::vector<double> power(4001), energy(4001, 0.);
      for (std::size_t i = 0; i < power.size(); ++i)
        {
          power[i] = noise(generator);
          if (i > 0)
            energy[i] = energy[i - 1] + 5e4 * power[i] * dt;
        }
      const auto mu = interface_friction_coefficient(times(4001, dt), energy,
                                                     load_of(5e4, 4001, dt), {0., 2e-5});
      covered += std::abs(mu.value - 0.2) <= mu.half_width;
      const auto mean = window_mean(times(4001, dt), power, {0., 2e-5});
      covered_mean += std::abs(mean.value - 0.2) <= mean.half_width;
    }
  EXPECT_GT(covered, 0.88 * trials);
  EXPECT_GT(covered_mean, 0.92 * trials);
  EXPECT_LT(covered_mean, 0.99 * trials);
}

TEST(Friction, MeanOverWholePeriods)
{
  const double dt   = 1e-7;
  const auto values = sampled(2001, dt, [](const double t) {
    return 0.21 + 0.3 * std::sin(2. * pi * 4e4 * t + 0.3);
  });
  // 6.6 periods asked for: 6 used, where the oscillation cancels.
  const auto mean = window_mean(times(2001, dt), values, {3.5e-5, 2.5e-5});
  EXPECT_NEAR(mean.value, 0.21, 1e-9);
  EXPECT_EQ(mean.batches, 6u);
}

TEST(Regimes, Labels)
{
  EXPECT_EQ(regime_label({1., 0., 0.}), "permanent slip");
  EXPECT_EQ(regime_label({0.995, 0.005, 0.}), "permanent slip");
  EXPECT_EQ(regime_label({0., 1., 0.}), "permanent stick");
  EXPECT_EQ(regime_label({0.6, 0.4, 0.}), "stick-slip");
  EXPECT_EQ(regime_label({0.7, 0., 0.3}), "slip-separation, regime 1 (mostly slipping)");
  EXPECT_EQ(regime_label({0.2, 0., 0.8}), "slip-separation, regime 2 (mostly separated)");
  EXPECT_EQ(regime_label({0.5, 0.2, 0.3}), "stick-slip-separation");
}

namespace
{
constexpr double step_length = 5e-9;

/** Counters of two nodes: one always slipping, one 7 of 10 steps in contact. */
std::vector<NodeCounts> two_nodes(const unsigned int n_blocks, const unsigned int steps)
{
  std::vector<NodeCounts> blocks(n_blocks);
  unsigned int step = 3;
  for (unsigned int b = 0; b < n_blocks; ++b)
    {
      NodeCounts &block = blocks[b];
      block.first_step  = b * steps;
      block.n_steps     = steps;
      block.slip        = {static_cast<float>(steps), 0.f};
      block.stick = block.landings = {0.f, 0.f};
      for (unsigned int i = 0; i < steps; ++i, ++step)
        {
          const unsigned int phase = step % 10;
          block.stick[1] += phase < 2;
          block.slip[1] += phase >= 2 && phase < 7;
          block.landings[1] += phase == 0;
        }
    }
  return blocks;
}
} // namespace

TEST(ContactShares, SharesAndDurationByConstruction)
{
  // Blocks of 13 steps cut the episodes anywhere; 10 blocks hold whole periods again.
  const auto blocks  = two_nodes(20, 13);
  const auto summary = summarize_contact(blocks, 2, step_length, 10 * 13 * step_length);
  EXPECT_NEAR(summary.node_shares[1].stick, 0.2, 1e-14);
  EXPECT_NEAR(summary.node_shares[1].slip, 0.5, 1e-14);
  EXPECT_NEAR(summary.node_shares[1].separation, 0.3, 1e-14);
  EXPECT_NEAR(summary.shares.slip, 0.75, 1e-14);
  EXPECT_NEAR(summary.duration.mean, (130 + 91) * step_length / 13., 1e-17);

  // One node of two: just enough to speak for all; one of three is not.
  EXPECT_EQ(summary.duration.node_share, 0.5);
  EXPECT_TRUE(summary.duration.representative());
  auto three = blocks;
  for (NodeCounts &block : three)
    for (std::vector<float> *values : {&block.stick, &block.slip, &block.landings})
      values->push_back(values->front());
  const auto few = summarize_contact(three, 3, step_length, 0.).duration;
  EXPECT_NEAR(few.node_share, 1. / 3., 1e-15);
  EXPECT_TRUE(few.complete());
  EXPECT_FALSE(few.representative());

  // Never separated: the duration is only a lower bound.
  const auto lasting = summarize_contact(blocks, 1, step_length, 10 * 13 * step_length);
  EXPECT_FALSE(lasting.duration.complete());
  EXPECT_NEAR(lasting.duration.mean, 130 * step_length, 1e-18);
}

TEST(ContactShares, WindowWithoutABlockTakesTheLastOne)
{
  auto blocks    = two_nodes(3, 100);
  blocks[2].slip = {60.f, 0.f};
  EXPECT_EQ(summarize_contact(blocks, 1, step_length, 1.3e-6).shares.slip, 0.6);
}

TEST(PhaseDiagram, AFoldedCircle)
{
  const double dt = 5e-8, f = 41321., w = 2. * pi * f;
  const auto u = sampled(
    20000, dt, [w](const double t) { return -4e-7 + 1e-6 * std::sin(w * t + 1.); });
  const auto v =
    sampled(20000, dt, [w](const double t) { return 1e-6 * w * std::cos(w * t + 1.); });
  for (const double expected : {0., 2.4e-5})
    {
      const auto diagram = mean_phase_diagram(u, v, dt, expected);
      ASSERT_EQ(diagram.displacement.size(), 200u);
      EXPECT_EQ(diagram.n_periods, 40u);
      for (unsigned int i = 0; i < 200; ++i)
        {
          const double angle = 2. * pi * (i + 0.5) / 200.;
          EXPECT_NEAR(diagram.displacement[i], -4e-7 + 1e-6 * std::sin(angle), 1e-8);
          EXPECT_NEAR(diagram.velocity[i], 1e-6 * w * std::cos(angle), 1e-2 * 1e-6 * w);
          EXPECT_LT(diagram.displacement_spread[i], 3e-8);
        }
    }
}

// Straight lines between samples lose 1 - cos(pi / 8), 8 %, where the motion is fastest.
TEST(PhaseDiagram, OfEightSamplesACycle)
{
  const double f = 41321., w = 2. * pi * f, dt = 1. / (8. * f);
  const auto u = sampled(400, dt, [w](const double t) { return std::sin(w * t + 1.); });
  const auto v = sampled(400, dt, [w](const double t) { return std::cos(w * t + 1.); });
  const auto diagram = mean_phase_diagram(u, v, dt, 1. / f);
  ASSERT_EQ(diagram.velocity.size(), 200u);
  for (unsigned int i = 0; i < 200; ++i)
    EXPECT_NEAR(diagram.velocity[i], std::cos(2. * pi * (i + 0.5) / 200.), 0.02);
}

TEST(PhaseDiagram, HarmonicsAndNoiseAreNoPeriods)
{
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0., 0.05);
  const double dt = 5e-8, w = 2. * pi * 4e4;
  const auto u       = sampled(20000, dt, [&](const double t) {
    return std::sin(w * t) + 0.8 * std::sin(2. * w * t) + noise(generator);
  });
  const auto diagram = mean_phase_diagram(u, u, dt);
  EXPECT_EQ(diagram.n_periods, 39u);
  EXPECT_EQ(
    mean_phase_diagram(std::vector<double>(100, 1.), std::vector<double>(100, 0.), dt)
      .n_periods,
    0u);
}
