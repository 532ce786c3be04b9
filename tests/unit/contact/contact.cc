#include "contact/contact_recorder.h"

#include "../../measured.h"
#include "contact_testing.h"

#include <complex>
#include <gtest/gtest.h>

using namespace contact_testing;

namespace
{
constexpr double mu = 0.25, delta = 1.5e-6, mass = 0.03;

/** A node that cannot follow the flat, so that it slips whatever the friction is. */
Points slipping_node(const double dt, const ContactSetup &setup)
{
  Points point(setup, step_of(dt), {mass});
  point.hold_x(0);
  return point;
}

Points slipping_node(const double dt, const double flat_velocity = 2.)
{
  return slipping_node(dt, contact_setup(1, mu, flat_velocity, delta));
}

/** Friction over mu times the normal force, n steps after this force has risen during
 *  one step, as eq. (7) has it. */
double after_a_rise(const double dt, const double time, const unsigned int n)
{
  return 1. + time / dt * std::expm1(-dt / time) * std::exp(-(n * dt) / time);
}

double ramp_error(const double dt)
{
  const double slope = 4e9, end = 6e-6;
  Points point = slipping_node(dt);
  double t     = 0.;
  for (int n = 0; n <= std::lround(end / dt); ++n)
    {
      t = point.time();
      point.load(0, 0., slope * t);
      point.advance();
    }
  return point.friction() / (mu * slope * (t - delta * (1. - std::exp(-t / delta)))) - 1.;
}

/** Complex amplitude of the friction over that of mu times the normal force. */
std::complex<double> gain(const double omega, const unsigned int steps_per_period)
{
  const std::complex<double> i(0., 1.);
  const double dt = 2. * M_PI / omega / steps_per_period;
  Points point    = slipping_node(dt);
  std::complex<double> amplitude;
  const unsigned int n_start =
    steps_per_period * std::ceil(40. * delta / dt / steps_per_period);
  for (unsigned int n = 0; n < n_start + steps_per_period; ++n)
    {
      const double phase = 2. * M_PI * n / steps_per_period;
      point.load(0, 0., 1000. + 600. * std::cos(phase));
      point.advance();
      if (n >= n_start)
        amplitude +=
          point.friction() * std::exp(-i * phase) * 2. / double(steps_per_period);
    }
  return amplitude / (mu * 600.);
}
} // namespace

TEST(FrictionLaw, RelaxesAfterANormalStressStepAsFigure2)
{
  const double dt = delta / 20., N0 = 400., N1 = 1000.;
  for (const double V : {2., -2.})
    {
      Points point = slipping_node(dt, V);
      point.load(0, 0., N0);
      for (unsigned int n = 1; n <= 1000; ++n)
        {
          point.advance();
          ASSERT_NEAR(point.friction(),
                      std::copysign(mu * N0 * after_a_rise(dt, delta, n - 1), V), 1e-11);
          ASSERT_NEAR(point.pressing(), N0, 1e-10);
        }
      point.load(0, 0., N1);
      for (unsigned int n = 1; n <= 200; ++n)
        {
          point.advance();
          const double expected = mu * (N0 + (N1 - N0) * after_a_rise(dt, delta, n - 1));
          ASSERT_NEAR(point.friction(), std::copysign(expected, V), 1e-11);
        }
    }
}

TEST(FrictionLaw, LagsBehindARamp)
{
  // The law is exact for a target that is linear in time, whatever the step.
  for (const double dt : {3e-6, 1e-7, 5e-8, 2.5e-8, 1.25e-8})
    EXPECT_NEAR(ramp_error(dt), 0., 1e-12) << dt;
}

TEST(FrictionLaw, MeanOverAContactIsThatOfEquation11)
{
  // The contact ends half a step before and after the steps that touch; the rise of the
  // force during the step before the first one is centred there.
  const double N = 700.;
  for (const unsigned int steps : {1u, 2u, 7u, 40u})
    for (const double dt : {5e-6, 3e-7, 1e-9})
      {
        Points point = slipping_node(dt);
        double sum   = 0.;
        for (unsigned int n = 0; n < steps; ++n)
          {
            point.load(0, 0., N);
            point.advance();
            sum += point.friction();
          }
        const double T    = steps * dt,
                     mean = mu * N * (1. + delta / T * std::expm1(-T / delta));
        EXPECT_NEAR(sum / steps, mean, 1e-11) << steps << " steps of " << dt;
      }
}

TEST(FrictionLaw, WeightsOfOneStep)
{
  for (const double x : {1e-300, 1e-18, 1e-9, 1e-4, 1., 30., 1e4})
    {
      const Relaxation relaxation(x * delta, delta);
      EXPECT_LE(0., relaxation.decay);
      EXPECT_LE(relaxation.decay, relaxation.lag);
      EXPECT_LE(relaxation.lag, 1.);
      EXPECT_NEAR(relaxation.decay, std::exp(-x), 2e-16);
      if (x < 1e-3)
        {
          EXPECT_NEAR(relaxation.lag, 1. - x / 2. + x * x / 6., x * x * x / 20. + 2e-16);
        }
      else
        {
          EXPECT_NEAR(relaxation.lag, (1. - std::exp(-x)) / x, 1e-15);
        }
    }
  const Relaxation coulomb(1e-8, 0.);
  EXPECT_EQ(coulomb.decay, 0.);
  EXPECT_EQ(coulomb.lag, 0.);
}

TEST(FrictionLaw, FiltersAHarmonicNormalForce)
{
  const std::complex<double> i(0., 1.);
  const double omega               = 2. * M_PI * 1e5;
  const std::complex<double> exact = 1. / (1. + i * omega * delta);
  double last                      = 0.;
  for (const unsigned int steps : {100u, 200u, 400u})
    {
      const std::complex<double> found = gain(omega, steps);
      const double dt = 2. * M_PI / omega / steps, q = std::exp(-dt / delta);
      const double mean                 = (1. - q) / (dt / delta);
      const std::complex<double> before = std::exp(-i * omega * dt);
      EXPECT_LT(std::abs(found - (1. - mean + (mean - q) * before) / (1. - q * before)),
                1e-12);
      const double error = std::abs(found - exact);
      measured::error("friction under a harmonic force", steps, error);
      if (last > 0.)
        {
          EXPECT_NEAR(std::log2(last / error), 2., 0.01);
        }
      last = error;
      // A straight line between the samples lacks (omega dt)^2 / 12 of the amplitude.
      const double lacking = omega * dt * omega * dt / 12.;
      EXPECT_NEAR(std::abs(found) * std::hypot(1., omega * delta), 1., 1.05 * lacking);
      EXPECT_NEAR(-std::arg(found), std::atan(omega * delta), 1.05 * lacking);
    }
}

TEST(FrictionLaw, CoulombAtOnce)
{
  Points point = slipping_node(1e-8, contact_setup(1, mu, 2., 0.));
  for (const double N : {100., 7., 3000.})
    {
      point.load(0, 0., N);
      point.advance();
      EXPECT_NEAR(point.friction(), mu * N, 1e-10);
      EXPECT_EQ(point.friction(), mu * point.pressing());
    }
}

TEST(FrictionLaw, SlipRateDependentTime)
{
  ContactSetup setup = contact_setup(2, mu, 2., delta);
  setup.law.node_law = std::make_shared<SlipRateRegularization>(3e-6, 0.25);
  const double dt    = 5e-8;
  Points points(setup, step_of(dt), {mass, 1e30});
  points.hold_x(0);
  points.w.row(0, 0)[1] = -1.5; // heavy: keeps its velocity
  points.load(0, 0., 500.);
  points.load(1, 0., 500.);
  for (unsigned int n = 1; n <= 100; ++n)
    {
      points.advance();
      for (const unsigned int i : {0u, 1u})
        {
          const double time = 3e-6 / ((i == 0 ? 2. : 3.5) + 0.25);
          ASSERT_NEAR(points.friction(i), mu * 500. * after_a_rise(dt, time, n - 1),
                      1e-10);
        }
    }
}

TEST(FrictionLaw, SlipRateThatChangesFromStepToStep)
{
  // Slip at V + v(t) over the distance s(t) relaxes to mu N as exp(-(s + V_ref t) / L).
  const double L = 3e-6, V_ref = 0.25, V = 2., N = 500., omega = 1e6, end = 3e-6;
  double last = 0.;
  for (const double dt : {1e-7, 5e-8, 2.5e-8})
    {
      ContactSetup setup = contact_setup(1, mu, V, 0.);
      setup.law.node_law = std::make_shared<SlipRateRegularization>(L, V_ref);
      Points point(setup, step_of(dt), {mass});
      point.hold_x(0);
      point.load(0, 0., N);
      const unsigned int n_steps = std::lround(end / dt);
      for (unsigned int n = 0; n < n_steps; ++n)
        {
          point.w.row(0, 0)[0] = -std::sin(omega * (n + 0.5) * dt); // half a step on
          point.advance();
        }
      const double s     = (V + V_ref) * end + (1. - std::cos(omega * end)) / omega;
      const double first = 0.5 * dt * (V + V_ref); // landed half a step on
      const double error =
        point.friction() / (-mu * N * std::expm1(-(s - first) / L)) - 1.;
      if (last != 0.)
        {
          EXPECT_NEAR(std::log2(last / error), 2., 0.1);
        }
      last = error;
    }
  EXPECT_LT(std::abs(last), 1e-4);
}

TEST(ContactPoint, SticksBelowTheLimit)
{
  const double N = 100., dt = 1e-7, V = 0.3;
  for (const double share : {0.99, -0.99, 1.01, -1.01})
    {
      Points point(contact_setup(1, mu, V, 0.), step_of(dt, 0.7), {mass});
      point.w.row(0, 0)[0] = V;
      point.load(0, share * mu * N, N);
      for (unsigned int n = 1; n <= 50; ++n)
        point.advance();
      const bool sticks = std::abs(share) < 1.;
      const double x = point.u.row(0, 0)[0], flat = V * point.time();
      EXPECT_EQ(point.history().sticking.back(), sticks);
      EXPECT_EQ(point.history().slipping.back(), !sticks);
      EXPECT_EQ(point.history().separated.back(), 0.);
      if (sticks)
        {
          EXPECT_NEAR(point.friction(), -share * mu * N, 1e-9);
          EXPECT_NEAR(x, flat, 1e-14 * flat);
          EXPECT_NEAR(point.contact.work().friction, 0., 1e-20);
        }
      else
        {
          EXPECT_NEAR(point.friction(), std::copysign(mu * N, -share), 1e-9);
          EXPECT_GT((x - flat) * share, 0.);
          EXPECT_GT(point.contact.work().friction, 0.);
        }
    }
}

TEST(ContactPoint, MemoryNeverDragsFasterThanTheFlat)
{
  // The memory holds mu 1000 N/m; then the pressure drops and the flat hardly moves.
  ContactSetup setup  = contact_setup(1, mu, 0., delta);
  setup.flat_velocity = LoadHistory(1., "if(t < 2.9995e-5, 2, 5e-5)");
  Points point(setup, step_of(1e-8), {mass});
  point.load(0, 0., 1000.);
  for (unsigned int n = 0; n < 3000; ++n)
    {
      point.u.row(0, 0)[0] = point.w.row(0, 0)[0] = 0.;
      point.advance();
    }
  ASSERT_NEAR(point.friction(), mu * 1000., 1e-3);
  point.u.row(0, 0)[0] = point.w.row(0, 0)[0] = 0.;
  point.load(0, 0., 100.);
  point.advance();
  const double to_stick = 5e-5 * 1e-8 * mass / (1e-8 * 1e-8);
  ASSERT_GT(to_stick, mu * 100.);
  ASSERT_LT(to_stick, mu * 1000. * std::exp(-1e-8 / delta));
  EXPECT_NEAR(point.friction(), to_stick, 1e-9);
  EXPECT_NEAR(point.w.row(0, 0)[0], 5e-5, 1e-16);
  EXPECT_EQ(point.history().slipping.back(), 1.);

  // Against the motion of the flat the memory is not cut.
  point.w.row(0, 0)[0] = 1.;
  point.advance();
  EXPECT_GT(point.friction(),
            to_stick * std::exp(-2e-8 / delta) - mu * 100. * 1e-8 / delta);
  EXPECT_LT(point.friction(), to_stick);
}

TEST(ContactPoint, SeparationClearsTheMemory)
{
  const double dt = delta / 30.;
  Points point    = slipping_node(dt);
  point.load(0, 0., 800.);
  for (unsigned int n = 0; n < 90; ++n)
    point.advance();
  ASSERT_GT(point.friction(), 0.9 * mu * 800.);
  point.load(0, 0., -1.);
  point.advance();
  EXPECT_EQ(point.friction(), 0.);
  EXPECT_EQ(point.pressing(), 0.);
  EXPECT_EQ(point.history().separated.back(), 1.);
  EXPECT_GT(point.u.row(1, 0)[0], 0.);
  point.load(0, 0., 800.);
  point.advance();
  EXPECT_NEAR(point.u.row(1, 0)[0], 0., 1e-24);
  EXPECT_NEAR(point.friction(), mu * point.pressing() * after_a_rise(dt, delta, 0),
              1e-10);
  const NodeCounts counts = point.counts();
  EXPECT_EQ(counts.n_steps, 92u);
  EXPECT_EQ(counts.slip[0], 91.f);
  EXPECT_EQ(counts.stick[0], 0.f);
  EXPECT_EQ(counts.landings[0], 2.f);
}

TEST(ContactPoint, FallsThroughTheGapOntoTheFlat)
{
  const double g = 10., gap = 0.05, dt = 1e-3;
  for (const double b : {0.5, 1.})
    {
      ContactSetup setup = contact_setup(1, mu, 0., 0.);
      setup.gap          = gap;
      Points point(setup, step_of(dt, b), {mass});
      point.load(0, 0., mass * g);
      point.w.row(1, 0)[0]     = b * g * dt; // v_0 = 0
      const unsigned int n_end = 0.95 * std::sqrt(2. * gap / g) / dt;
      for (unsigned int n = 0; n < n_end; ++n)
        point.advance();
      const MonitoredNode &node = point.history().nodes[0];
      for (unsigned int n = 0; n < n_end; ++n)
        ASSERT_NEAR(node.vy[n], -g * n * dt, 1e-12);
      EXPECT_NEAR(node.uy.back(), -0.5 * g * dt * dt * (n_end - 1.) * (n_end - 1.),
                  1e-12);
      for (unsigned int n = 0; n < 50; ++n)
        point.advance();
      EXPECT_NEAR(point.u.row(1, 0)[0], -gap, 1e-16);
      EXPECT_NEAR(point.pressing(), mass * g, 1e-8);
    }
}
