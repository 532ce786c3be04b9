#include "observation/steady_state.h"

#include "io/errors.h"

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <sstream>

using namespace mesoslip;

namespace
{
constexpr double pi = 3.14159265358979323846;

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
} // namespace

namespace
{
/** Oscillator growing at @p rate until it saturates at amplitude 1 um near 0.3 ms. */
double growing(const double t, const double rate = 2.5e4)
{
  const double grown = std::exp(rate * (t - 3e-4));
  return -4e-7 + 1e-6 * grown / (1. + grown) * std::sin(2. * pi * 41321. * t);
}

double friction_energy(const double t)
{
  return 1e4 * t + 0.05 * std::sin(2. * pi * 41321. * t);
}
} // namespace

TEST(LimitCycle, GrowingThenSaturatingOscillator)
{
  const double dt     = 2e-8;
  const auto signal   = sampled(50000, dt, [](const double t) { return growing(t); });
  const auto energy   = sampled(50000, dt, friction_energy);
  const auto detector = detect_limit_cycle(times(50000, dt), signal, energy);
  ASSERT_TRUE(detector.reached());
  EXPECT_FALSE(detector.steady_sliding());
  // 2 % below saturation at 0.3 ms + ln(49) / 2.5e4 = 0.456 ms; windows of 73 us.
  EXPECT_GT(detector.steady_from(), 3.8e-4);
  EXPECT_LT(detector.steady_from(), 5.5e-4);
  EXPECT_NEAR(*detector.reached_at() - detector.steady_from(), 9. / 41321., 1e-6);
  EXPECT_NEAR(detector.period() * 41321., 1., 5e-3);
  EXPECT_NEAR(detector.history().back().amplitude, 1e-6 / std::sqrt(2.), 1e-8);
  EXPECT_NE(detector.description().find("reached at"), std::string::npos);
}

TEST(LimitCycle, ChunksAndCheckpointsChangeNothing)
{
  const double dt   = 2e-8;
  const auto signal = sampled(50000, dt, [](const double t) { return growing(t); });
  const auto energy = sampled(50000, dt, friction_energy);
  const auto whole  = detect_limit_cycle(times(50000, dt), signal, energy);
  LimitCycleDetector first, second;
  for (std::size_t i = 0; i < 17321; ++i)
    first.add(static_cast<double>(i) * dt, signal[i], energy[i]);
  std::stringstream file;
  boost::archive::binary_oarchive(file) << first;
  boost::archive::binary_iarchive(file) >> second;
  for (std::size_t i = 17321; i < 50000; ++i)
    second.add(static_cast<double>(i) * dt, signal[i], energy[i]);
  EXPECT_EQ(second.steady_from(), whole.steady_from());
  EXPECT_EQ(second.history().size(), whole.history().size());
  EXPECT_EQ(second.history().back().amplitude, whole.history().back().amplitude);
}

TEST(LimitCycle, NoiseIsNoObstacle)
{
  std::mt19937 generator(11);
  std::normal_distribution<double> noise(0., 5e-8);
  const double dt = 2e-8;
  const auto signal =
    sampled(50000, dt, [&](const double t) { return growing(t) + noise(generator); });
  const auto detector =
    detect_limit_cycle(times(50000, dt), signal, sampled(50000, dt, friction_energy));
  ASSERT_TRUE(detector.reached());
  EXPECT_GT(detector.steady_from(), 3.8e-4);
  EXPECT_LT(detector.steady_from(), 5.5e-4);
}

TEST(LimitCycle, NeverReachedWhileGrowingOrWhileThePowerDrifts)
{
  const double dt   = 2e-8;
  const auto signal = sampled(50000, dt, [](const double t) {
    return 1e-6 * std::exp(2e3 * t) * std::sin(2. * pi * 41321. * t);
  });
  const auto growing_detector =
    detect_limit_cycle(times(50000, dt), signal, sampled(50000, dt, friction_energy));
  EXPECT_FALSE(growing_detector.reached());
  EXPECT_FALSE(growing_detector.reached_at());
  EXPECT_EQ(growing_detector.steady_from(), 2.5e-4);
  EXPECT_NEAR(growing_detector.steady_from(9e-4), 5e-4, dt);
  EXPECT_NE(growing_detector.description().find("not reached"), std::string::npos);

  const auto steady = sampled(
    50000, dt, [](const double t) { return 1e-6 * std::sin(2. * pi * 41321. * t); });
  const auto drifting = sampled(50000, dt, [](const double t) { return 1e7 * t * t; });
  EXPECT_FALSE(detect_limit_cycle(times(50000, dt), steady, drifting).reached());
}

TEST(LimitCycle, SteadySlidingIsSteadyUnlessAVibrationGrows)
{
  const double dt   = 2e-8;
  const auto linear = sampled(20000, dt, [](const double t) { return 1e4 * t; });
  const auto settled =
    sampled(20000, dt, [](const double t) { return 2e-7 * (1. - std::exp(-t / 2e-5)); });
  const auto detector = detect_limit_cycle(times(20000, dt), settled, linear);
  EXPECT_TRUE(detector.reached());
  EXPECT_TRUE(detector.steady_sliding());
  EXPECT_GT(detector.steady_from(), 5e-5);

  const auto unstable = sampled(20000, dt, [](const double t) {
    return 2e-7 + 1e-15 * std::exp(2e4 * t) * std::sin(2. * pi * 4.5e4 * t);
  });
  EXPECT_FALSE(detect_limit_cycle(times(20000, dt), unstable, linear).reached());

  LimitCycleDetector bad;
  EXPECT_THROW(bad.add(0., std::nan(""), 0.), NumericalFailure);
}
