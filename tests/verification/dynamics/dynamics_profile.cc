#include "../../measured.h"
#include "../sliding/sliding_body.h"

#include <complex>
#include <gtest/gtest.h>

using namespace verification;

namespace profile
{
namespace
{
constexpr double E = 70e9, nu = 0.3, rho = 2700., wave_length = 1e-3, p0 = 1e6;

/** Steady motion of a half space over height * cos(k (x - V t)) without friction, from two evanescent waves. */
struct SteadyWave
{
  double V, height, k = 2. * M_PI / wave_length;
  double mu = E / (2. * (1. + nu)), c_T = std::sqrt(mu / rho),
         c_L = c_T * std::sqrt(2. * (1. - nu) / (1. - 2. * nu));
  double d = std::sqrt(1. - V * V / (c_L * c_L)), s = std::sqrt(1. - V * V / (c_T * c_T)),
         A = height * (1. + s * s) / (k * d * (1. - s * s)),
         B = -2. * d * A / (1. + s * s);

  double
  displacement(const double x, const double y, const double t, const unsigned int c) const
  {
    const double phase = k * (x - V * t), of_d = std::exp(-d * k * y),
                 of_s = std::exp(-s * k * y);
    return c == 0 ? -k * (A * of_d + s * B * of_s) * std::sin(phase)
                  : -k * (d * A * of_d + B * of_s) * std::cos(phase);
  }

  /** Amplitude of the pressure on the profile (Pa). */
  double pressure() const
  {
    const double rayleigh = 4. * d * s - (1. + s * s) * (1. + s * s);
    return mu * k * height * rayleigh / (d * (1. - s * s));
  }
};

/** What the contact of @p n cells a wave length finds for that pressure, with its phase, over that. */
std::complex<double> found_over_exact(const SteadyWave &wave, const unsigned int n)
{
  BodySetup setup;
  setup.cells    = {{n, 2 * n}};
  setup.spacing  = {{wave_length / n, wave_length / n}};
  setup.classes  = {{isotropic_stiffness<2>(E, nu), rho}};
  setup.ids      = std::vector<std::uint8_t>(setup.cells[0] * setup.cells[1], 0);
  setup.periodic = true;
  setup.contact.flat_velocity = LoadHistory(wave.V);
  setup.contact.law.time      = 0.;
  setup.contact.profile       = std::make_shared<ProfileExpression>(
    std::to_string(1e12 * wave.height) + "e-12*cos(2*pi*x/1e-3)", 2);
  setup.top.is_platen   = false;
  setup.top.pressure    = LoadHistory(p0);
  setup.energy_interval = 1;
  setup.choose_time_step(0.95);
  Body body(setup);
  const double dt = setup.step.dt, D22 = setup.classes[0].stiffness(1, 1);
  body.set_u([&](const double x, const double y, const unsigned int c) {
    return wave.displacement(x, y, 0., c) - (c == 1 ? p0 / D22 * y : 0.);
  });
  body.set_w([&](const double x, const double y, const unsigned int c) {
    return (wave.displacement(x, y, 0., c) - wave.displacement(x, y, -dt, c)) / dt;
  });
  std::complex<double> sum = 0.;
  const unsigned int steps = std::lround(0.25 * wave_length / (wave.V * dt));
  for (unsigned int m = 0; m < steps; ++m)
    {
      body.run(1);
      for (unsigned int i = 0; i < n; ++i)
        sum += body.contact.normal_force()[i] *
               std::exp(std::complex<double>(
                 0., wave.k * (i * setup.spacing[0] - wave.V * m * dt)));
    }
  const EnergyHistory energy = body.energy->reduce();
  EXPECT_LT(largest(energy.residual()), 1e-12 * largest(energy.elastic));
  EXPECT_EQ(largest(energy.friction), 0.);
  return 2. * sum / (wave_length * steps) / wave.pressure();
}
} // namespace

// Its pressure is 4 % and 18 % less than that of a profile at rest at these speeds.
TEST(Profile, MovesAWaveOfKnownPressureThroughTheBody)
{
  for (const double V : {700., 1500.})
    {
      const SteadyWave wave{V, 1e-10};
      const double at_rest = E / (1. - nu * nu) * 0.5 * wave.k * wave.height;
      EXPECT_GT(1. - wave.pressure() / at_rest, V < 1000. ? 0.03 : 0.15)
        << wave.pressure() / at_rest;
      std::vector<double> errors;
      for (const unsigned int n : {16, 32, 64})
        {
          const std::complex<double> found = found_over_exact(wave, n);
          errors.push_back(std::abs(found - 1.));
          std::printf("V = %g m/s, %u cells a wave: %.5f, phase %.5f\n", V, n,
                      std::abs(found), std::arg(found));
          measured::number("pressure over a profile at " +
                             std::to_string(std::lround(V)) + " m/s",
                           wave.pressure(), wave.pressure() * std::abs(found));
        }
      EXPECT_LT(errors[2], 2e-3);
      EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2., 0.5);
      EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2., 0.5);
    }
}
} // namespace profile
