#include "../../measured.h"
#include "rectangle_mode.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::exact_modes;

namespace
{
/** Amplitude of the mode over time, starting from 1 at rest. */
std::vector<double>
amplitudes(const BodySetup &setup, const DiscreteMode &mode, const unsigned int n_steps)
{
  HeldBelow bottom(setup.step);
  Body body(setup, MPI_COMM_SELF, &bottom);
  // v_0 = w_0 + b dt a_0 = 0 with a_0 = -omega^2 (u_0 + beta w_0)
  const double W2 = mode.omega * mode.omega, b_dt = setup.step.beta2 * setup.step.dt;
  const double w0 = b_dt * W2 / (1. - b_dt * W2 * setup.step.beta);
  body.u = body.w = mode.shape;
  for (std::size_t k = 0; k < body.w.size(); ++k)
    body.w.begin()[k] *= w0;
  std::vector<double> q;
  const double norm = mass_product(body.material, mode.shape, mode.shape);
  for (unsigned int n = 0; n <= n_steps; ++n)
    {
      q.push_back(mass_product(body.material, body.u, mode.shape) / norm);
      if (n < n_steps)
        body.run(1);
    }
  return q;
}

/** Error of the amplitude at the time @p T against cos(omega T). */
double error_at(const BodySetup &setup,
                const DiscreteMode &mode,
                const double omega,
                const unsigned int n_steps)
{
  return amplitudes(setup, mode, n_steps).back() -
         std::cos(omega * n_steps * setup.step.dt);
}
} // namespace

TEST(Rectangle, FrequenciesConvergeWithOrderTwo)
{
  for (const Mode mode :
       {Mode{1, 0, true}, Mode{2, 1, true}, Mode{1, 0, false}, Mode{0, 1, false}})
    {
      std::vector<double> errors;
      for (const unsigned int n : {8, 16, 32, 64})
        {
          const BodySetup setup = rectangle(n);
          errors.push_back(
            discrete_mode(setup, mode).omega / mode.omega(setup.classes[0]) - 1.);
          measured::error("frequency, mode " + std::to_string(mode.m) + " " +
                            std::to_string(mode.n) +
                            (mode.shear ? " shear" : " pressure"),
                          n, errors.back());
        }
      EXPECT_NEAR(orders(errors).back(), 2., 0.02) << mode.m << mode.n << mode.shear;
      EXPECT_LT(std::abs(errors.back()), 3e-3);
    }
}

TEST(Rectangle, MotionConvergesWithOrderTwoInSpaceAndTime)
{
  for (const Mode mode : {Mode{1, 0, true}, Mode{1, 0, false}})
    {
      std::vector<double> errors;
      for (const unsigned int n : {12, 24, 48})
        {
          BodySetup setup    = rectangle(n);
          const double omega = mode.omega(setup.classes[0]), T = 5.3 * 2. * M_PI / omega;
          const unsigned int n_steps = n * 30;
          setup.step.dt              = T / n_steps;
          errors.push_back(error_at(setup, discrete_mode(setup, mode), omega, n_steps));
          measured::error(std::string("motion, ") + (mode.shear ? "shear" : "pressure"),
                          n, errors.back());
        }
      EXPECT_NEAR(orders(errors).back(), 2., 0.1) << mode.shear;
      EXPECT_LT(std::abs(errors.back()), 0.03);
    }
}

TEST(Rectangle, OrderInTime)
{
  const Mode mode{1, 0, true};
  BodySetup setup             = rectangle(8);
  const DiscreteMode discrete = discrete_mode(setup, mode);
  const double T              = 3.3 * 2. * M_PI / discrete.omega;
  for (const double b : {0.5, 0.6, 1.})
    {
      std::vector<double> errors;
      for (const unsigned int n_steps : {400, 800, 1600, 3200})
        {
          setup.step.beta2 = b;
          setup.step.dt    = T / n_steps;
          errors.push_back(error_at(setup, discrete, discrete.omega, n_steps));
          measured::error("time step, beta2 = " + std::to_string(b).substr(0, 3), n_steps,
                          errors.back());
        }
      EXPECT_NEAR(orders(errors).back(), b == 0.5 ? 2. : 1., 0.05) << "beta2 " << b;
      EXPECT_GT(std::abs(errors.back()), 1e-7);
    }
}

TEST(Rectangle, DecaysByBetaAndByBeta2)
{
  const Mode mode{1, 0, true};
  BodySetup setup             = rectangle(8);
  const DiscreteMode discrete = discrete_mode(setup, mode);
  const double omega          = discrete.omega;
  for (const double b : {0.5, 0.75, 1.})
    for (const double beta : {0., 1e-7, 4e-7})
      {
        setup.step.beta2 = b;
        setup.step.beta  = beta;
        setup.choose_time_step(0.8);
        const double dt = setup.step.dt, W = omega * dt, xi = 0.5 * beta * omega;
        const double found = frequency_and_decay(amplitudes(setup, discrete, 600), dt)[1];
        // The product of the two eigenvalues of the scheme, and what it stands for.
        const double exact = -0.5 * std::log1p(-2. * xi * W - (b - 0.5) * W * W) / dt;
        EXPECT_NEAR(found, exact, 1e-8 * omega) << "beta2 " << b << " beta " << beta;
        measured::number("decay (1/s)", exact, found);
        const double rate = 0.5 * omega * omega * (beta + (b - 0.5) * dt);
        EXPECT_NEAR(found, rate, 0.04 * rate + 1e-8 * omega);
      }
}

TEST(Rectangle, EnergyBoundedWithoutTrend)
{
  BodySetup setup       = rectangle(12);
  setup.energy_interval = 1;
  setup.choose_time_step(0.99);
  HeldBelow bottom(setup.step);
  Body body(setup, MPI_COMM_SELF, &bottom);
  for (const Mode mode : {Mode{1, 0, true}, Mode{2, 2, false}})
    {
      const DiscreteMode d = discrete_mode(setup, mode);
      for (std::size_t k = 0; k < body.u.size(); ++k)
        body.u.begin()[k] += d.shape.begin()[k] * 1e-6;
    }
  body.run(20000);
  const EnergyHistory e = body.energy->reduce();
  const double total    = e.kinetic.front() + e.elastic.front();
  for (std::size_t n = 0; n < e.time.size(); ++n)
    ASSERT_NEAR(e.kinetic[n] + e.elastic[n], total, 1e-12 * total);
}
