#include "sliding_body.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
/** A small pin that separates, slips and (at low speed) sticks. */
BodySetup pin(const double pressure, const double speed)
{
  BodySetup s;
  s.cells   = {{41, 17}};
  s.spacing = {{1e-3, 1e-3}};
  s.classes = {resin(), {isotropic_stiffness<2>(1.2e11, 0.25), 2600.}};
  for (unsigned int i = 0; i < 41 * 17; ++i)
    s.ids.push_back(i % 7 == 2 || i % 11 == 4);
  s.friction              = 0.4;
  s.contact.flat_velocity = LoadHistory(speed);
  s.top.pressure          = LoadHistory(pressure);
  s.step.beta             = 4.4e-9;
  s.energy_interval       = 1;
  s.choose_time_step(0.95);
  return s;
}

struct Shares
{
  double stick = 0., slip = 0., separated = 0.;
};

Shares shares(const ContactHistory &h)
{
  Shares s;
  for (std::size_t n = 0; n < h.time.size(); ++n)
    {
      s.stick += h.sticking[n];
      s.slip += h.slipping[n];
      s.separated += h.separated[n];
    }
  return s;
}

/** Largest difference of two histories, the second times @p factor, over the largest
 * value. */
double difference(const std::vector<double> &a,
                  const std::vector<double> &b,
                  const double factor)
{
  EXPECT_EQ(a.size(), b.size());
  std::vector<double> d(a);
  for (std::size_t n = 0; n < a.size(); ++n)
    d[n] -= factor * b[n];
  const double size = largest(a);
  return size > 0. ? largest(d) / size : largest(d);
}

/** All histories of two runs agree when forces are scaled by @p s, energies by its
 * square. */
void expect_scaled(const Body &a, const Body &b, const double s, const double tolerance)
{
  EXPECT_LE(relative_difference(a.u, b.u, s), tolerance);
  EXPECT_LE(relative_difference(a.w, b.w, s), tolerance);
  const ContactHistory &x = a.contact_recorder.history(),
                       &y = b.contact_recorder.history();
  EXPECT_LE(difference(x.normal_force, y.normal_force, s), tolerance);
  EXPECT_LE(difference(x.tangential_force, y.tangential_force, s), tolerance);
  EXPECT_EQ(difference(x.sticking, y.sticking, 1.), 0.);
  EXPECT_EQ(difference(x.slipping, y.slipping, 1.), 0.);
  const EnergyHistory e = a.energy->reduce(), f = b.energy->reduce();
  for (const auto term : {&EnergyHistory::kinetic, &EnergyHistory::elastic,
                          &EnergyHistory::impact, &EnergyHistory::damping})
    EXPECT_LE(difference(e.*term, f.*term, s * s), tolerance);
}
} // namespace

TEST(Scaling, PressureAndVelocityTogether)
{
  const unsigned int n_steps = 3000;
  Body reference(pin(5e6, 0.2));
  reference.run(n_steps);
  const Shares states = shares(reference.contact_recorder.history());
  EXPECT_GT(states.stick, 100.);
  EXPECT_GT(states.slip, 1000.);
  EXPECT_GT(states.separated, 100.);
  for (const double s : {2., 3.})
    {
      Body scaled(pin(s * 5e6, s * 0.2));
      scaled.run(n_steps);
      const double tolerance = s == 2. ? 0. : 1e-11;
      expect_scaled(scaled, reference, s, tolerance);
      const EnergyHistory e = scaled.energy->reduce(), f = reference.energy->reduce();
      EXPECT_LE(difference(e.friction, f.friction, s * s), tolerance);
      EXPECT_LE(difference(e.external_work, f.external_work, s * s), tolerance);
    }
  // Not so with a law that has a velocity of its own.
  BodySetup other            = pin(5e6, 0.2);
  other.contact.law.node_law = std::make_shared<SlipRateRegularization>(3e-6, 1e-3);
  Body one(other);
  other.contact.flat_velocity = LoadHistory(0.4);
  other.top.pressure          = LoadHistory(1e7);
  Body two(other);
  one.run(n_steps);
  two.run(n_steps);
  EXPECT_GT(relative_difference(two.u, one.u, 2.), 1e-3);
}

TEST(Scaling, PressureAloneWhileNothingSticks)
{
  const unsigned int n_steps = 2000;
  Body reference(pin(5e5, 40.));
  reference.run(n_steps);
  EXPECT_EQ(shares(reference.contact_recorder.history()).stick, 0.);
  EXPECT_GT(shares(reference.contact_recorder.history()).separated, 100.);
  Body scaled(pin(1e6, 40.)), faster(pin(5e5, 70.));
  scaled.run(n_steps);
  expect_scaled(scaled, reference, 2., 0.);
  faster.run(n_steps);
  expect_scaled(faster, reference, 1., 0.);
  // With sticking the velocity matters.
  Body slow(pin(5e6, 0.2)), slow_scaled(pin(1e7, 0.2));
  slow.run(n_steps);
  slow_scaled.run(n_steps);
  EXPECT_GT(relative_difference(slow_scaled.u, slow.u, 2.), 1e-3);
}

TEST(Symmetry, ReversedFlatGivesTheMirrorImage)
{
  const unsigned int n_steps = 2500, columns = 42;
  BodySetup setup = pin(5e6, 1.);
  Body right(setup);
  setup.contact.flat_velocity = LoadHistory(-1.);
  for (unsigned int j = 0; j < 17; ++j)
    std::reverse(setup.ids.begin() + 41 * j, setup.ids.begin() + 41 * (j + 1));
  Body left(setup);
  right.run(n_steps);
  left.run(n_steps);
  NodalField<double> mirrored = left.u;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < left.u.n_rows(); ++j)
      for (unsigned int i = 0; i < columns; ++i)
        mirrored.row(c, j)[i] = (c == 0 ? -1. : 1.) * left.u.row(c, j)[columns - 1 - i];
  EXPECT_LT(relative_difference(right.u, mirrored), 1e-11);
  EXPECT_GT(relative_difference(right.u, left.u), 0.1);
  const ContactHistory &r = right.contact_recorder.history(),
                       &l = left.contact_recorder.history();
  EXPECT_LT(difference(r.normal_force, l.normal_force, 1.), 1e-11);
  EXPECT_LT(difference(r.tangential_force, l.tangential_force, -1.), 1e-11);
  EXPECT_EQ(difference(r.slipping, l.slipping, 1.), 0.);
  EXPECT_LT(difference(right.top_recorder.history().tangential_force,
                       left.top_recorder.history().tangential_force, -1.),
            1e-11);
  const EnergyHistory e = right.energy->reduce(), f = left.energy->reduce();
  EXPECT_LT(difference(e.friction, f.friction, 1.), 1e-11);
  EXPECT_GT(e.friction.back(), 0.);
  EXPECT_LT(difference(e.external_work, f.external_work, 1.), 1e-11);
}

TEST(Symmetry, MillimetresAndTonnes)
{
  const unsigned int n_steps = 2500;
  for (const bool slip_rate : {false, true})
    {
      BodySetup metres         = pin(5e6, 0.5);
      metres.contact.gap       = 1e-8;
      metres.step.acceleration = {{10., -2e4}};
      metres.top.platen_mass   = 0.1;
      BodySetup millimetres    = metres;
      if (slip_rate)
        {
          metres.contact.law.node_law =
            std::make_shared<SlipRateRegularization>(3e-6, 1e-3);
          millimetres.contact.law.node_law =
            std::make_shared<SlipRateRegularization>(3e-3, 1.);
        }
      for (double &h : millimetres.spacing)
        h *= 1e3;
      for (ElasticPhase<2> &c : millimetres.classes)
        {
          c.stiffness *= 1e-6;
          c.density *= 1e-12;
        }
      for (double &a : millimetres.step.acceleration)
        a *= 1e3;
      millimetres.contact.flat_velocity = LoadHistory(0.5e3);
      millimetres.contact.gap *= 1e3;
      millimetres.top.pressure    = LoadHistory(5.);
      millimetres.top.platen_mass = 0.1 * 1e-6; // t/mm
      const double dt             = metres.step.dt;
      millimetres.choose_time_step(0.95);
      EXPECT_NEAR(millimetres.step.dt, dt, 1e-9 * dt);
      millimetres.step.dt = dt;
      Body a(millimetres), b(metres);
      a.run(n_steps);
      b.run(n_steps);
      EXPECT_LT(relative_difference(a.u, b.u, 1e3), 1e-11);
      EXPECT_LT(relative_difference(a.w, b.w, 1e3), 1e-11);
      const EnergyHistory e = a.energy->reduce(), f = b.energy->reduce();
      // N/m = 1e-3 N/mm, J/m = N = N mm / mm
      EXPECT_LT(difference(a.contact_recorder.history().normal_force,
                           b.contact_recorder.history().normal_force, 1e-3),
                1e-11);
      EXPECT_LT(difference(e.friction, f.friction, 1.), 1e-11);
      EXPECT_LT(difference(e.elastic, f.elastic, 1.), 1e-11);
      EXPECT_LT(largest(e.residual()), 1e-12 * largest(e.external_work));
    }
}
