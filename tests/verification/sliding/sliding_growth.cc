#include "sliding_layer.h"

#include "../../measured.h"

#include <cstdio>
#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
const Layer damped_layer = {1., 0.25, 1.5e-6, 4.4e-9};

/** With @p sizes cells over the height. */
template <int dim>
void expect_growth(const Layer &layer,
                   const double growth,
                   const double frequency,
                   const std::vector<unsigned int> &sizes,
                   const std::string &what = "")
{
  const Complex s = layer.fastest();
  EXPECT_NEAR(s.real(), growth, 2e-3);
  EXPECT_NEAR(std::abs(s.imag()) / (2. * M_PI), frequency, 2e-3);

  std::vector<double> errors, law_errors;
  for (const unsigned int n : sizes)
    {
      const BodySetup setup = layer_setup(layer, n);
      const Growth seen     = observed<dim>(setup, layer, s);
      EXPECT_TRUE(seen.slipping);
      const Complex found = seen.rate;
      Layer discrete      = layer;
      discrete.dt         = setup.step.dt;
      const Complex exact = discrete.root(s);
      errors.push_back(std::abs(found - exact));
      law_errors.push_back(std::abs(exact - s));
      const std::string law = (layer.delta > 0. ? "regularized" : "Coulomb") + what;
      measured::error("growth, " + law, n, errors.back() / std::abs(s));
      if (dim == 2 && layer.delta > 0.)
        measured::error("growth, the law in time", n, law_errors.back() / std::abs(s));
      std::printf(
        "H/%u: growth %.1f 1/s at %.2f Hz; error %.5f %% of s, of the law %.5f %%\n", n,
        found.real(), std::abs(found.imag()) / (2. * M_PI),
        100. * errors.back() / std::abs(s), 100. * law_errors.back() / std::abs(s));
      if (n == sizes.back())
        {
          const std::string size = ", H/" + std::to_string(n) + what;
          EXPECT_NEAR(found.real(), s.real(), 0.01 * s.real());
          measured::number("growth (1/s)" + size, growth, found.real());
          measured::number("frequency (Hz)" + size, frequency,
                           std::abs(found.imag()) / (2. * M_PI));
          EXPECT_NEAR(found.imag(), s.imag(), 1e-3 * std::abs(s.imag()));
        }
    }
  EXPECT_NEAR(orders(errors).back(), 2., 0.25);
  if (layer.delta > 0.)
    {
      EXPECT_NEAR(orders(law_errors).back(), 2., 0.01);
    }
}

/** Order of the growth rate's change with the time step on one grid, each change being
 *  that of the discrete relation. */
template <int dim>
double order_in_dt(const Layer &layer)
{
  const Complex s = layer.fastest();
  BodySetup setup = layer_setup(layer, 20);
  std::vector<Complex> found, predicted;
  for (const double dt : {16e-8, 8e-8, 4e-8})
    {
      setup.step.dt  = dt;
      Layer discrete = layer;
      discrete.dt = discrete.scheme_dt = dt;
      found.push_back(observed<dim>(setup, layer, s).rate);
      predicted.push_back(discrete.root(s));
    }
  const Complex limit = found[2] + s - predicted[2]; // of this grid
  for (const unsigned int n : {0u, 1u, 2u})
    if (dim == 2 && layer.beta == 0.)
      measured::error("growth, time step", 1u << n,
                      std::abs(found[n] - limit) / std::abs(s));
  for (const unsigned int n : {0u, 1u})
    {
      const Complex due = predicted[n] - predicted[n + 1];
      EXPECT_LT(std::abs(found[n] - found[n + 1] - due), 0.05 * std::abs(due));
    }
  return std::log2(std::abs((found[0] - found[1]) / (found[1] - found[2])));
}

/** By how much s changes as damping acts on a velocity half a step old. */
Complex damping_shift(const Complex s, const double dt)
{
  Layer early = damped_layer, leapfrog = damped_layer, exact = damped_layer;
  early.scheme_dt = leapfrog.scheme_dt = dt;
  leapfrog.beta = exact.beta = 0.;
  return early.root(s) - s - (leapfrog.root(s) - exact.root(s));
}

/** Ten columns and ten rows of squares, periodic. */
BodySetup grid_wave_setup(const double h, const double delta, const double beta)
{
  Layer layer{1., 0.25, delta, beta};
  BodySetup setup = layer_setup(layer, 20);
  setup.cells     = {{10, 10}};
  setup.spacing   = {{h, h}};
  setup.step.dt   = 0.8 * h / layer.c_L();
  return setup;
}

/** What three waves in ten columns do while the layer slides. */
Complex grid_wave(const BodySetup &setup)
{
  Body body(setup);
  const auto &D       = setup.classes[0].stiffness;
  const double height = setup.cells[1] * setup.spacing[1];
  body.set_u([&](const double, const double y, const unsigned int c) {
    return c == 0 ? 0.25 * P / D(2, 2) * (height - y) : -P / D(1, 1) * y;
  });
  body.set_w([&](const double x, const double y, const unsigned int c) {
    const double phase = 0.6 * M_PI * x / setup.spacing[0];
    return c == 0 && y == 0. ? 1e-8 * std::cos(phase) : 0.;
  });
  FourierProbe probe(body, 3, 1);
  body.run(800, &probe);
  for (const double n : body.contact_recorder.history().slipping)
    EXPECT_EQ(n, setup.cells[0]);
  return probe.rate(400 * setup.step.dt);
}
} // namespace

TEST(Growth, Coulomb)
{
  expect_growth<2>({1.15, 0.25, 0., 0.}, 30030.410, 49264.050, {20, 40, 80});
}

// Numbers of a derivation by others, with G = 12.5 GPa.
TEST(Growth, OnSprings)
{
  Layer layer   = {1.15, 0.25, 0., 0.};
  layer.springs = 1e15 * Layer::G / 12.5e9;
  EXPECT_NEAR(layer.fastest().real(), 30025.295, 2e-3);
  EXPECT_NEAR(std::abs(layer.fastest().imag()) / (2. * M_PI), 49227.795, 2e-3);
  layer.springs = 1e13 * Layer::G / 12.5e9;
  expect_growth<2>(layer, 28061.032, 45707.747, {20, 40, 80}, ", springs");
  expect_growth<3>(layer, 28061.032, 45707.747, {20, 40}, ", box on springs");
}

TEST(Growth, OnSpringsRegularizedAndDamped)
{
  Layer layer     = damped_layer;
  layer.springs   = 3e13;
  const Complex s = layer.fastest();
  expect_growth<2>(layer, s.real(), std::abs(s.imag()) / (2. * M_PI), {20, 40, 80},
                   ", springs");
}

TEST(Growth, DampedByMassAndStiffness)
{
  Layer layer     = damped_layer;
  layer.alpha     = 3e4;
  const Complex s = layer.fastest();
  EXPECT_NEAR(damped_layer.fastest().real() - s.real(), 1.5e4, 500.);
  const double frequency = std::abs(s.imag()) / (2. * M_PI);
  expect_growth<2>(layer, s.real(), frequency, {20, 40, 80}, ", alpha");
  expect_growth<3>(layer, s.real(), frequency, {20, 40}, ", box, alpha");
}

TEST(Growth, RegularizedAndDamped)
{
  expect_growth<2>(damped_layer, 23574.532, 45632.343, {20, 40, 80});
}

TEST(BoxGrowth, Coulomb)
{
  expect_growth<3>({1.15, 0.25, 0., 0.}, 30030.410, 49264.050, {20, 40}, ", box");
}

TEST(BoxGrowth, RegularizedAndDamped)
{
  expect_growth<3>(damped_layer, 23574.532, 45632.343, {20, 40}, ", box");
}

TEST(BoxGrowth, OfOrderTwoInTheTimeStep)
{
  Layer layer = damped_layer;
  layer.beta  = 0.;
  EXPECT_NEAR(order_in_dt<3>(layer), 2., 0.05);
}

TEST(Growth, OfOrderTwoInTheTimeStep)
{
  // One grid, so that what changes is the time step; the discrete relation predicts it.
  Layer layer = damped_layer;
  layer.beta  = 0.;
  EXPECT_NEAR(order_in_dt<2>(layer), 2., 0.05);

  // Damping acts half a step early: a stiffness larger by beta omega^2 dt / 2.
  const Complex s = damped_layer.fastest();
  for (const double dt : {4e-8, 1e-8})
    {
      const double estimate = 0.25 * damped_layer.beta * s.imag() * s.imag() * dt;
      const double shift    = damping_shift(s, dt).imag() / s.imag();
      EXPECT_NEAR(shift, estimate, 0.05 * estimate);
      EXPECT_LT(shift, 4e-6);
    }
  EXPECT_GT(order_in_dt<2>(damped_layer), 1.8);
}

TEST(Growth, OfTheGridWithoutDampingAndRegularization)
{
  // A half-space of these squares has a wave of 10/3 cells within three rows of the flat,
  // which bodies have not. Eigenvalue for nu = 0.2, mu = 0.25, by numpy: s h / c_T.
  const Complex grid(0.0330625, -2.6404373);
  for (const double h : {8e-4, 4e-4})
    {
      Complex s             = grid * c_T / h;
      const BodySetup setup = grid_wave_setup(h, 0., 0.);
      const double dt       = setup.step.dt;
      s                     = 2. / dt * std::asinh(0.5 * dt * s); // leapfrog
      const Complex found   = grid_wave(setup);
      measured::number("growth (1/s), h = " + std::to_string(std::lround(1e6 * h)) +
                         " micrometres",
                       s.real(), found.real());
      EXPECT_LT(std::abs(found - s), 1e-3 * s.real());
      EXPECT_LT(grid_wave(grid_wave_setup(h, 0., 4.4e-9)).real(), 0.);
      EXPECT_LT(grid_wave(grid_wave_setup(h, 1.5e-6, 0.)).real(), 0.01 * s.real());
    }
}
