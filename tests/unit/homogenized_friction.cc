#include "homogenization/homogenized_friction.h"

#include "base/errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace mesoslip;

// Eq. (12) integrated numerically, an independent path to eq. (13).
TEST(HomogenizedFriction, MeanEqualsItsIntegral)
{
  const double mu = 0.25, delta = 1.5e-6, duration = 1.7e-5;
  const int n = 100000;
  double sum  = 0.;
  for (int i = 0; i < n; ++i)
    sum += mu * (1. - std::exp(-(i + 0.5) / n * duration / delta)) / n;
  EXPECT_NEAR(mean_friction_coefficient(mu, delta, duration), sum, 1e-9);
}

TEST(HomogenizedFriction, LimitsKeepTheirDigits)
{
  EXPECT_EQ(mean_friction_coefficient(0.25, 0., 1e-5), 0.25);
  EXPECT_EQ(mean_friction_coefficient(0.25, 1e-300, 1e10), 0.25);
  for (const double x : {1e-14, 1e-9, 1e-5})
    EXPECT_NEAR(mean_friction_coefficient(1., 1., x) / (x / 2. - x * x / 6.), 1., 1e-10);
  // Both branches of the evaluation meet.
  EXPECT_NEAR(mean_friction_coefficient(1., 1., std::nextafter(0.5, 1.)),
              mean_friction_coefficient(1., 1., 0.5), 1e-15);
}

TEST(HomogenizedFriction, InverseReturnsTheRegularizationTime)
{
  for (double ratio = 1e-9; ratio < 1e9; ratio *= 7.3)
    {
      const double duration = 1.2e-5, delta = ratio * duration;
      const double mean = mean_friction_coefficient(0.25, delta, duration);
      // mu - mu_bar itself has lost digits where delta << T_G.
      const double conditioning = 1. + 1. / ratio;
      EXPECT_NEAR(regularization_time_for(mean, 0.25, duration) / delta, 1.,
                  1e-14 * conditioning + 1e-13)
        << "delta / T_G = " << ratio;
    }
}

TEST(HomogenizedFriction, NoRegularizationTimeBeyondTheRange)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double mean : {0.25, 0.3, 0., -0.1, nan})
    EXPECT_THROW(regularization_time_for(mean, 0.25, 1e-5), UserError) << mean;
  EXPECT_THROW(regularization_time_for(0.2, 0.25, 0.), UserError);
  EXPECT_THROW(mean_friction_coefficient(0.25, -1e-6, 1e-5), UserError);
  EXPECT_THROW(mean_friction_coefficient(0.25, 1e-6, nan), UserError);
  EXPECT_THROW(mean_friction_coefficient(nan, 1e-6, 1e-5), UserError);
}

// Table 4 of the paper.
TEST(HomogenizedFriction, Table4)
{
  const std::vector<ContactPhase> phases = {{0.1, 240e9, 0.3}, {0.9, 30e9, 0.12}};
  const auto pressures                   = static_pressure_repartition(0.5e6, phases);
  EXPECT_NEAR(pressures[0], 2.35e6, 0.005e6);
  EXPECT_NEAR(pressures[1], 0.29e6, 0.005e6);
  EXPECT_NEAR(homogenized_friction_coefficient(phases), 0.20, 0.005);
  EXPECT_NEAR(homogenized_friction_coefficient(phases, pressures, 0.5e6),
              (0.1 * 0.3 * 240. + 0.9 * 0.12 * 30.) / (0.1 * 240. + 0.9 * 30.), 1e-15);
  EXPECT_NEAR(homogenized_friction_coefficient(phases, {2e6, 0.33e6}, 0.5e6), 0.19,
              0.005);
}

TEST(HomogenizedFriction, OnlyRatiosOfAreasMatterAndAnyNumberOfPhases)
{
  const std::vector<ContactPhase> phases = {
    {2., 1e9, 0.1}, {3., 2e9, 0.2}, {5., 4e9, 0.4}};
  std::vector<ContactPhase> scaled = phases;
  for (auto &phase : scaled)
    phase.area *= 1e-3;
  const auto pressures = static_pressure_repartition(1e6, phases);
  const double force   = 2. * pressures[0] + 3. * pressures[1] + 5. * pressures[2];
  EXPECT_NEAR(force, 10e6, 1e-6);
  EXPECT_NEAR(homogenized_friction_coefficient(phases), 9.4 / 28., 1e-15);
  EXPECT_NEAR(homogenized_friction_coefficient(scaled),
              homogenized_friction_coefficient(phases, pressures), 1e-15);
}

TEST(HomogenizedFriction, BadPhasesAreRejected)
{
  EXPECT_THROW(homogenized_friction_coefficient({}), UserError);
  EXPECT_THROW(homogenized_friction_coefficient({{0., 1e9, 0.1}}), UserError);
  EXPECT_THROW(homogenized_friction_coefficient({{1., 0., 0.1}}), UserError);
  EXPECT_THROW(homogenized_friction_coefficient({{1., 0., 0.1}}, {1., 2.}), UserError);
  EXPECT_THROW(homogenized_friction_coefficient({{1., 0., 0.1}}, {0.}), UserError);
}
