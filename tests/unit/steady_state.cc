#include "observation/steady_state.h"
#include "observation/steady_record.h"
#include "unit/material/material_testing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

using namespace mesoslip;
using material_testing::pi;

namespace
{
constexpr double frequency = 41321., time_step = 2e-8;
constexpr unsigned int n_samples = 50000; // 1 ms

double oscillation(const double t)
{
  return std::sin(2. * pi * frequency * t);
}

/** Oscillator growing at @p rate until it saturates at amplitude 1 um near 0.3 ms. */
double growing(const double t, const double rate = 2.5e4)
{
  const double grown = std::exp(rate * (t - 3e-4));
  return -4e-7 + 1e-6 * grown / (1. + grown) * oscillation(t);
}

/** A sample of a pin that slides at 2 m/s under 5 MPa; the motion is that of two nodes.
 */
CycleSample sliding(const double t, const double u)
{
  CycleSample sample;
  sample.time             = t;
  sample.displacement     = {u, 0.7 * u};
  sample.friction_energy  = 1e4 * t + 0.05 * oscillation(t);
  sample.normal_force     = 2.8e5 * (1. + 0.3 * oscillation(t));
  sample.tangential_force = 0.25 * sample.normal_force;
  sample.sticking         = 0.1;
  sample.slipping         = 0.8 + 0.1 * oscillation(t);
  sample.kinetic_energy   = 0.2 * (1. + 0.5 * oscillation(t));
  sample.elastic_energy   = 0.5;
  return sample;
}

LimitCycleDetector judge(const std::function<CycleSample(const double)> &run,
                         const unsigned int n = n_samples)
{
  LimitCycleDetector detector;
  for (unsigned int i = 0; i < n; ++i)
    detector.add(run(i * time_step));
  return detector;
}
} // namespace

TEST(CycleRecord, MergedBinsKeepMeansAndVariances)
{
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(3., 0.5);
  CycleRecord merged(16), whole(4096);
  for (unsigned int i = 0; i < 1024; ++i)
    {
      const std::vector<double> values = {noise(generator),
                                          1e6 + 1e-3 * noise(generator)};
      merged.add(values);
      whole.add(values);
    }
  ASSERT_EQ(merged.size() * merged.stride(), 1024u);
  ASSERT_GT(merged.stride(), 32u);
  ASSERT_EQ(whole.size(), 1024u);
  for (std::size_t column : {0, 1})
    {
      EXPECT_NEAR(merged.mean(column, 2, 6) /
                    whole.mean(column, 2 * merged.stride(), 6 * merged.stride()),
                  1., 1e-14);
      EXPECT_NEAR(merged.variance(column, 2, 6) /
                    whole.variance(column, 2 * merged.stride(), 6 * merged.stride()),
                  1., 1e-6);
    }
}

// The first third of the second half has the least amplitude; it misses saturation by
// 1 / (1 + exp(rate (t - 0.3 ms))), whose integral is known.
TEST(LimitCycle, GrowingThenSaturatingOscillator)
{
  const auto detector = judge([](const double t) { return sliding(t, growing(t)); });
  ASSERT_TRUE(detector.reached());
  // Half of the run, less at most one period a third.
  const double half = 0.5 * detector.reached_at();
  EXPECT_GE(detector.steady_from(), half - time_step);
  EXPECT_LE(detector.steady_from(), half + 3. / frequency);
  const double from = detector.steady_from(), third = (detector.reached_at() - from) / 3.;
  const auto missing = [](const double t) {
    return std::log1p(std::exp(-2.5e4 * (t - 3e-4)));
  };
  const double lack = (missing(from) - missing(from + third)) / 2.5e4 / third;
  // Met by now, but not at the check before, 1.5 periods earlier at the beginning.
  EXPECT_LT(lack, 0.0202);
  EXPECT_GT(lack, 0.0198 * std::exp(-2.5e4 * 1.5 / frequency));
  EXPECT_NEAR(detector.period() * frequency, 1., 5e-3);
  EXPECT_NE(detector.description().find("Limit cycle from "), std::string::npos);
}

TEST(LimitCycle, NoiseIsNoObstacle)
{
  std::mt19937 generator(11);
  std::normal_distribution<double> noise(0., 5e-8);
  const auto detector =
    judge([&](const double t) { return sliding(t, growing(t) + noise(generator)); });
  ASSERT_TRUE(detector.reached());
  EXPECT_GT(detector.steady_from(), 3.7e-4);
}

TEST(LimitCycle, NotReachedWhileTheAmplitudeGrows)
{
  const auto detector = judge(
    [](const double t) { return sliding(t, 1e-6 * std::exp(2e3 * t) * oscillation(t)); });
  EXPECT_FALSE(detector.reached());
  EXPECT_EQ(detector.reached_at(), 0.);
  EXPECT_NEAR(detector.steady_from(), 0.5 * (n_samples - 1) * time_step, 1e-12);
  EXPECT_NE(detector.description().find("No limit cycle by "), std::string::npos);
  EXPECT_NE(detector.description().find("an amplitude"), std::string::npos);
}

// The motion at the nodes is steady from the start; one other thing drifts by 10 % in 1
// ms, which is 3 % between the outer thirds of the second half.
TEST(LimitCycle, EverythingHasToBeSteady)
{
  const auto steady = [](const double t) { return sliding(t, 1e-6 * oscillation(t)); };
  EXPECT_TRUE(judge(steady).reached());
  using Change = std::function<void(CycleSample &, double)>;
  const std::vector<std::pair<std::string, Change>> changes = {
    {"frictional power",
     [](auto &s, const double x) { s.friction_energy += 5e4 * s.time * x; }},
    {"apparent friction", [](auto &s, const double x) { s.tangential_force *= 1. + x; }},
    {"share of sticking", [](auto &s, const double x) { s.sticking += x; }},
    {"share of slipping", [](auto &s, const double x) { s.slipping -= x; }},
    {"kinetic energy", [](auto &s, const double x) { s.kinetic_energy *= 1. + x; }},
    {"elastic energy", [](auto &s, const double x) { s.elastic_energy *= 1. + x; }},
    {"mean displacement", [](auto &s, const double x) { s.displacement[0] += 1e-6 * x; }},
    {"amplitude", [](auto &s, const double x) { s.displacement[1] *= 1. + x; }}};
  for (const auto &[name, change] : changes)
    {
      const auto detector = judge([&, &apply = change](const double t) {
        CycleSample sample = steady(t);
        apply(sample, 100. * t);
        return sample;
      });
      EXPECT_FALSE(detector.reached()) << name;
      EXPECT_NE(detector.description().find(name), std::string::npos)
        << name << ": " << detector.description();
    }
}

// A plateau passes once it is half of the run. What grows later takes that back.
TEST(LimitCycle, WithdrawnWhenSomethingStillGrows)
{
  const auto run = [](const double t) {
    return sliding(t, 1e-6 * oscillation(t) + 1e-9 * std::exp(2e4 * (t - 5e-4)) *
                                                std::sin(2. * pi * 124e3 * t));
  };
  EXPECT_TRUE(judge(run, 25000).reached());
  EXPECT_FALSE(judge(run, n_samples).reached());
}

TEST(LimitCycle, SlowBeatsAverageOut)
{
  const auto detector = judge(
    [](const double t) {
      const double beat  = 1. + 0.1 * std::sin(2. * pi * 4e3 * t);
      CycleSample sample = sliding(t, 1e-6 * beat * oscillation(t));
      sample.kinetic_energy *= beat;
      return sample;
    },
    4 * n_samples);
  EXPECT_TRUE(detector.reached());
  // Not within the beat's 0.25 ms, in which the kinetic energy varies by 20 %.
  EXPECT_GT(detector.reached_at(), 5e-4);
}

TEST(LimitCycle, SteadySlidingIsSteadyUnlessAVibrationGrows)
{
  const auto calm = [](const double t, const double u, const double decay) {
    CycleSample sample;
    sample.time             = t;
    sample.displacement     = {u};
    sample.friction_energy  = 1e4 * t;
    sample.normal_force     = 1.;
    sample.tangential_force = 0.25;
    sample.slipping         = 1.;
    sample.elastic_energy   = 1. + decay;
    sample.kinetic_energy   = decay * decay;
    return sample;
  };
  const auto detector = judge(
    [&](const double t) {
      const double decay = std::exp(-t / 2e-5);
      return calm(t, 2e-7 * (1. - decay), decay);
    },
    30000);
  EXPECT_TRUE(detector.reached());
  EXPECT_NE(detector.description().find("Steady sliding from "), std::string::npos);
  EXPECT_GT(detector.steady_from(), 5e-5);

  const auto unstable = judge(
    [&](const double t) {
      return calm(t, 2e-7 + 1e-15 * std::exp(2e4 * t) * std::sin(2. * pi * 4.5e4 * t),
                  0.);
    },
    30000);
  EXPECT_FALSE(unstable.reached());

  LimitCycleDetector bad;
  EXPECT_FALSE(bad.add(calm(0., std::nan(""), 0.)));
}

// Five samples a period: in a long run a bin of the record holds many of them, and its
// means would show some other frequency.
TEST(LimitCycle, SeparationNeedsThatNothingPresses)
{
  // Its vibration decays by a factor e in 0.3 ms, so that energies never agree.
  const auto run = [](const double t) {
    CycleSample sample;
    const double decay  = std::exp(-t / 3e-4);
    sample.time         = t;
    sample.displacement = {1e-6 * decay * oscillation(t), 2e-6 * decay * oscillation(t)};
    sample.slipping     = t < 1e-4 ? 0.5 : 0.;
    sample.normal_force = t < 1e-4 ? 1e5 : 0.;
    sample.kinetic_energy = 0.2 * decay * decay;
    sample.elastic_energy = 0.2 * decay * decay;
    return sample;
  };
  EXPECT_FALSE(judge(run).reached());
  LimitCycleCriterion free;
  free.stays_apart = true;
  LimitCycleDetector detector(free);
  for (unsigned int i = 0; i < n_samples; ++i)
    detector.add(run(i * time_step));
  EXPECT_TRUE(detector.reached());
  // Once the second half of the run so far has three parts of three periods, which is
  // later than twice the time of the last contact; looked for every 2 %.
  const double nine_periods = 9. / frequency;
  EXPECT_GE(detector.reached_at(), 2. * nine_periods);
  EXPECT_LE(detector.reached_at(), 1.03 * 2. * nine_periods);
  EXPECT_EQ(detector.description().rfind("Separation from", 0), 0u)
    << detector.description();
  // A node that touches again withdraws the judgement.
  for (unsigned int i = n_samples; i < 2 * n_samples; ++i)
    {
      CycleSample sample = run(i * time_step);
      sample.slipping    = i % 100 < 50 ? 0.3 : 0.;
      detector.add(sample);
    }
  EXPECT_FALSE(detector.reached());
}

TEST(LimitCycle, PeriodOfALongRun)
{
  const double f = 1. / (5.3 * time_step);
  for (const unsigned int n : {10000, 50000, 300000})
    {
      const auto detector = judge(
        [f](const double t) { return sliding(t, 1e-6 * std::sin(2. * pi * f * t)); }, n);
      EXPECT_NEAR(detector.period() * f, 1., 1e-4) << n;
    }
}

namespace
{
/** Samples number @p first to @p last of a contact, every other step of 10 ns. */
ContactHistory contact_samples(const unsigned int first, const unsigned int last)
{
  ContactHistory h;
  h.nodes.resize(1);
  for (unsigned int k = first; k < last; ++k)
    {
      const double t = k * 2e-8;
      h.step.push_back(2 * k);
      h.time.push_back(t);
      h.nodes[0].ux.push_back(std::sin(2. * pi * t / 1e-6));
      h.nodes[0].vx.push_back(3.);
      h.friction_energy.push_back(100. * t * t);
      h.load_work.push_back(3. * t);
      h.normal_force.push_back(k % 7 == 0 ? 0. : 5.);
      h.tangential_force.push_back(1.);
    }
  return h;
}
} // namespace

TEST(SteadyRecord, SumsStayExactWhenValuesAreMerged)
{
  const unsigned int n = 4096;
  TopHistory top;
  for (unsigned int k = 0; k < n; ++k)
    {
      top.normal_force.push_back(k % 2 == 0 ? 2. : 0.);
      top.tangential_force.push_back(1.);
    }

  for (const std::size_t capacity : {8192, 512})
    {
      SteadyRecord record(2, 1e-8, capacity);
      for (unsigned int k = 0; k < n; k += 1024)
        record.add(contact_samples(k, k + 1024));
      record.add(top);
      const SteadySeries s      = record.series();
      const unsigned int merged = capacity == 512 ? 16 : 1;
      ASSERT_EQ(s.time.size(), n / merged);
      EXPECT_NEAR(s.interval, merged * 2e-8, 1e-20);
      EXPECT_EQ(s.first(s.time[7]), 7u);
      for (std::size_t b = 0; b < s.time.size(); ++b)
        {
          const unsigned int last = static_cast<unsigned int>(b + 1) * merged - 1;
          const double t          = last * 2e-8;
          ASSERT_NEAR(s.time[b], t, 1e-18);
          ASSERT_NEAR(s.friction_energy[b], 100. * t * t, 1e-20);
          ASSERT_NEAR(s.load_work[b], 3. * t, 1e-17);
        }
      EXPECT_EQ(s.velocity[5], 3.);
      EXPECT_EQ(record.top_friction()[3], merged == 1 ? 0. : 0.25);
      // A mean of T = 16 samples leaves sinc(f T) of a sine; the rest is its variance.
      const double x    = pi * 2e-8 * merged / 1e-6,
                   left = merged == 1 ? 1. : std::sin(x) / x;
      double within     = 0.;
      for (const double v : s.displacement_variance)
        within += v / static_cast<double>(s.time.size());
      EXPECT_NEAR(within, 0.5 * (1. - left * left), 2e-3);
    }
}
