#include "../sliding/sliding_body.h"
#include "contact/laws/rate_and_state.h"
#include "contact/laws/slip_weakening.h"
#include "contact/laws/stribeck.h"

#include "../../measured.h"
#include "../../unit/elasticity/elasticity_testing.h"

#include <gtest/gtest.h>

using namespace verification;

namespace
{
constexpr double V = 2., P = 5e6;

/** A small two-phase body thrown on the moving flat: sticks, slips, bounces. */
BodySetup thrown_body(const unsigned int nx = 22, const unsigned int ny = 9)
{
  BodySetup s;
  s.cells   = {{nx, ny}};
  s.spacing = {{5e-4, 4e-4}};
  s.classes = {resin(), {isotropic_stiffness<2>(1.2e11, 0.25), 2600.}};
  for (unsigned int i = 0; i < nx * ny; ++i)
    s.ids.push_back(i % 7 == 2 || i % 11 == 4);
  s.friction              = 0.4;
  s.contact.flat_velocity = LoadHistory(V);
  s.contact.gap           = 2e-7;
  s.top.pressure          = LoadHistory(P);
  s.energy_interval       = 1;
  return s;
}

struct Energies
{
  EnergyHistory e;
  double stick = 0., slip = 0., landings = 0.;
  double scale = 0.;
};

Energies
observe(BodySetup setup, const double safety = 0.95, const unsigned int n_steps = 4000)
{
  setup.choose_time_step(safety);
  Body body(setup);
  body.set_w([](const double x, const double y, const unsigned int c) {
    return c == 1 ? -1.5 + 0.3 * std::sin(900. * x + 400. * y) : 0.;
  });
  // What a platen or a held top does not let move does not move at the start either.
  if (setup.top.is_platen || setup.top.is_held())
    std::fill_n(body.w.row(1, body.w.n_rows() - 1), body.w.n_columns(),
                setup.top.is_held() ? 0. : -1.5);
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int j = 0; j < body.w.n_rows(); ++j)
      {
        if (setup.sides.left_held[c])
          body.w.row(c, j)[0] = 0.;
        if (setup.sides.right_held[c])
          body.w.row(c, j)[setup.cells[0]] = 0.;
      }
  body.run(n_steps);
  body.node_statistics.finish(body.contact);
  Energies found;
  found.e = body.energy->reduce();
  for (unsigned int i = 0; i <= setup.cells[0]; ++i)
    {
      found.stick += body.node_statistics.blocks()[0].stick[i];
      found.slip += body.node_statistics.blocks()[0].slip[i];
      found.landings += body.node_statistics.blocks()[0].landings[i];
    }
  for (const auto *values : {&found.e.kinetic, &found.e.elastic, &found.e.friction,
                             &found.e.external_work, &found.e.impact})
    found.scale = std::max(found.scale, largest(*values));
  return found;
}

void expect_closed(const BodySetup &setup, const char *what, const double safety = 0.95)
{
  const Energies found = observe(setup, safety);
  EXPECT_LT(largest(found.e.residual()) / found.scale, 1e-12) << what;
  measured::number(std::string("residual: ") + what, 0.,
                   largest(found.e.residual()) / found.scale);
  EXPECT_GT(found.slip, 1000.) << what;
  EXPECT_GT(found.landings, 50.) << what;
  EXPECT_GT(found.e.friction.back(), 1e-3 * found.scale) << what;
  // A body that overlaps with the flat at the start is pushed out in the first steps.
  const double pushed = *std::min_element(found.e.impact.begin(), found.e.impact.end());
  EXPECT_GT(found.e.impact.back() - pushed, 1e-5 * found.scale) << what;
}
} // namespace

TEST(Energy, ClosesUnderEveryTop)
{
  BodySetup setup = thrown_body();
  expect_closed(setup, "platen");
  setup.top.platen_mass = 0.05;
  expect_closed(setup, "platen with mass");
  setup.top.pressure = LoadHistory(P, "5e6*(1 + 0.5*sin(2*pi*3e4*t))");
  expect_closed(setup, "typed pressure");
  setup.top.is_platen   = false;
  setup.top.platen_mass = 0.;
  expect_closed(setup, "pressure");
  setup.top.held = {{true, true, false}};
  expect_closed(setup, "pressure, laterally held");
  setup.top.hold();
  setup.contact.gap = -2e-6;
  expect_closed(setup, "held");
}

// What springs store and take is in the balance; they take next to nothing for good, and stiff ones are the rigid flat.
TEST(Energy, ClosesOnSprings)
{
  BodySetup setup      = thrown_body();
  const Energies rigid = observe(setup);
  const double impact  = rigid.e.impact.back();
  EXPECT_EQ(largest(rigid.e.contact), 0.);
  for (const double stiffness : {1e13, 1e15, 1e25})
    {
      setup.contact.normal_spring.stiffness = stiffness;
      for (const double beta2 : {0.5, 0.8})
        {
          setup.step.beta2     = beta2;
          const Energies found = observe(setup);
          EXPECT_LT(largest(found.e.residual()) / found.scale, 1e-12) << stiffness;
          EXPECT_GT(largest(found.e.contact), 0.) << stiffness;
          EXPECT_GT(found.landings, 50.) << stiffness;
          for (std::size_t k = 1; k < found.e.impact.size(); ++k)
            ASSERT_GE(found.e.impact[k] - found.e.impact[k - 1], -1e-13 * found.scale)
              << stiffness << " at sample " << k;
        }
    }
  // A power that is as good as one is linear, another one stores and takes as well.
  setup.step.beta2                      = 0.5;
  setup.contact.normal_spring.stiffness = 1e14;
  const Energies linear                 = observe(setup);
  setup.contact.normal_spring.at        = P;
  setup.contact.normal_spring.exponent  = 1. + 1e-9;
  const Energies nearly                 = observe(setup);
  for (const auto term :
       {&EnergyHistory::impact, &EnergyHistory::contact, &EnergyHistory::elastic})
    EXPECT_NEAR((nearly.e.*term).back(), (linear.e.*term).back(), 1e-6 * linear.scale);
  for (const double exponent : {2., 3.3})
    for (const double beta2 : {0.5, 0.8})
      {
        setup.contact.normal_spring.exponent = exponent;
        setup.step.beta2                     = beta2;
        const Energies found                 = observe(setup);
        EXPECT_LT(largest(found.e.residual()) / found.scale, 1e-12) << exponent;
        EXPECT_GT(largest(found.e.contact), 1e-3 * found.scale) << exponent;
        for (std::size_t k = 1; k < found.e.impact.size(); ++k)
          ASSERT_GE(found.e.impact[k] - found.e.impact[k - 1], -1e-13 * found.scale)
            << exponent << " at sample " << k;
      }
  setup.contact.normal_spring.exponent  = 1.;
  setup.contact.normal_spring.stiffness = 1e25;
  setup.step.beta2                      = 0.5;
  const Energies stiff                  = observe(setup);
  EXPECT_NEAR(stiff.e.impact.back(), impact, 1e-6 * rigid.scale);
  setup.contact.normal_spring.stiffness = 1e13;
  EXPECT_LT(observe(setup, 0.2).e.impact.back(), 0.1 * impact);
  setup.top.hold(); // pressed from the start
  setup.contact.gap      = -2e-6;
  const Energies pressed = observe(setup);
  EXPECT_LT(largest(pressed.e.residual()) / pressed.scale, 1e-12);
  EXPECT_NEAR(pressed.e.contact[0], 0.5 * 1e13 * 2e-6 * 2e-6 * 0.011, 0.02); // J/m
}

// The flat rises and falls below the nodes, which is work; the impacts are not more than on the even flat allows.
TEST(Energy, ClosesOverAProfile)
{
  BodySetup setup       = thrown_body();
  setup.contact.gap     = 3e-6;
  setup.contact.profile = std::make_shared<ProfileExpression>(
    "2e-6*sin(2*pi*x/4e-3) + 5e-7*cos(2*pi*x/1.3e-3)", 2);
  for (const double stiffness : {1e14, std::numeric_limits<double>::infinity()})
    for (const double beta2 : {0.5, 0.8})
      {
        setup.contact.normal_spring.stiffness = stiffness;
        setup.step.beta2                      = beta2;
        expect_closed(setup, "profile");
      }
  setup.step.beta             = 4e-9;
  setup.step.alpha            = 2e4;
  setup.contact.flat_velocity = LoadHistory(V, "20*cos(2*pi*2e4*t)");
  expect_closed(setup, "profile to and fro");
}

// What springs along the flat store and let go is in the balance, whatever the law.
TEST(Energy, ClosesOnSpringsAlongTheFlat)
{
  BodySetup setup = thrown_body();
  for (const double stiffness : {1e12, 1e14, 1e25})
    for (const double beta2 : {0.5, 0.8})
      for (const double delta : {0., 1e-6})
        {
          setup.contact.tangential_stiffness = stiffness;
          setup.contact.law.time             = delta;
          setup.step.beta2                   = beta2;
          expect_closed(setup, "springs along the flat");
        }
  setup.step.beta2                   = 0.5;
  setup.contact.law.time             = 0.;
  const Energies stiff               = observe(setup);
  setup.contact.tangential_stiffness = std::numeric_limits<double>::infinity();
  const Energies rigid               = observe(setup);
  EXPECT_NEAR(stiff.e.friction.back(), rigid.e.friction.back(), 1e-6 * rigid.scale);
  EXPECT_EQ(stiff.stick, rigid.stick);
  setup.contact.tangential_stiffness    = 1e13;
  setup.contact.normal_spring.stiffness = 2e13;
  setup.contact.flat_velocity           = LoadHistory(V, "2*cos(2*pi*5e4*t)");
  setup.contact.law.reference           = setup.friction;
  setup.contact.law.coefficient_law =
    std::make_shared<Stribeck>(Stribeck({setup.friction, 0.2, 0.5, 1.5, 0.02}));
  setup.contact.law.normal_stress = {0., 2e-6, 0.1};
  expect_closed(setup, "springs along the flat, Stribeck");
}

TEST(Energy, ClosesWhenTheTopIsStopped)
{
  for (const double b : {0.5, 0.8})
    for (const bool platen : {true, false})
      {
        BodySetup setup     = thrown_body();
        setup.step.beta2    = b;
        setup.step.beta     = 4e-9;
        setup.top.is_platen = platen;
        setup.top.hold_from = 2.0371e-5;
        if (platen)
          setup.top.platen_mass = 0.03;
        const Energies found = observe(setup);
        EXPECT_LT(largest(found.e.residual()) / found.scale, 1e-12)
          << "beta2 " << b << " platen " << platen;
      }
}

TEST(Energy, ClosesWithEverythingElse)
{
  BodySetup setup         = thrown_body();
  setup.step.acceleration = {{300., -2e5}};
  expect_closed(setup, "gravity");
  setup.step.beta = 2e-8;
  expect_closed(setup, "gravity, damping");
  setup.step.beta2 = 0.8;
  expect_closed(setup, "gravity, damping, beta2 = 0.8");
  setup.step.alpha                      = 2e4;
  setup.contact.normal_spring.stiffness = 1e14;
  expect_closed(setup, "damping by the mass, springs");
  setup.contact.law.node_law  = std::make_shared<SlipRateRegularization>(3e-6, 1e-3);
  setup.contact.flat_velocity = LoadHistory(V, "2*cos(2*pi*2e4*t)");
  expect_closed(setup, "slip rate, flat to and fro");
  setup.sides.left_held  = {{true, false}};
  setup.sides.right_held = {{true, true}};
  setup.contact.law      = FrictionLaw();
  setup.top.is_platen    = false;
  setup.contact.law.time = 0.;
  expect_closed(setup, "held sides, Coulomb");
  setup.sides    = SideConstraints();
  setup.periodic = true;
  expect_closed(setup, "periodic, pressure");
  setup.top.is_platen = true;
  expect_closed(setup, "periodic, platen");
}

TEST(Energy, ClosesUnderEveryLawOfTheCoefficient)
{
  BodySetup setup               = thrown_body();
  FrictionLaw &law              = setup.contact.law;
  law.reference                 = setup.friction;
  const auto expect_closed_with = [&](const auto &of_coefficient, const char *name) {
    law.coefficient_law =
      std::make_shared<std::decay_t<decltype(of_coefficient)>>(of_coefficient);
    for (const double time : {0., 1e-6})
      for (const NormalStressMemory &memory :
           {NormalStressMemory(), NormalStressMemory{0., 2e-6, 0.1}})
        {
          law.time          = time;
          law.normal_stress = memory;
          expect_closed(setup, name);
        }
  };
  const double mu = setup.friction;
  expect_closed_with(Stribeck({mu, 0.2, 0.5, 1.5, 0.02}), "Stribeck");
  expect_closed_with(SlipWeakening({mu, 0.2, 1e-6, false, {Healing::Kind::sticking, 0.}}),
                     "slip weakening");
  expect_closed_with(RateAndState({mu, 0.01, 0.02, 1e-6, 1e-3, 1e-3, true}),
                     "rate and state");
}

TEST(Energy, FreeVibrationLosesNothing)
{
  BodySetup setup      = thrown_body();
  setup.contact.gap    = 1.;
  setup.top.is_platen  = false;
  setup.top.pressure   = LoadHistory();
  const Energies found = observe(setup, 0.99);
  EXPECT_LT(largest(found.e.residual()) / found.scale, 1e-12);
  measured::number("residual", 0., largest(found.e.residual()) / found.scale);
  for (const auto *term : {&found.e.friction, &found.e.impact, &found.e.damping,
                           &found.e.scheme, &found.e.external_work, &found.e.potential})
    EXPECT_EQ(largest(*term), 0.);
  EXPECT_GT(largest(found.e.elastic), 0.01 * largest(found.e.kinetic));
}

TEST(Energy, EveryTermWhereItBelongs)
{
  BodySetup setup         = thrown_body();
  setup.step.beta         = 2e-8;
  setup.step.beta2        = 0.8;
  setup.step.acceleration = {{0., -2e5}};
  const EnergyHistory e   = observe(setup).e;
  for (const auto *term :
       {&e.friction, &e.impact, &e.damping, &e.scheme, &e.external_work, &e.potential})
    EXPECT_GT(largest(*term), 1e-4 * e.initial);
  for (const auto *term : {&e.damping, &e.scheme, &e.impact})
    for (std::size_t n = 1; n < term->size(); ++n)
      ASSERT_GE((*term)[n], (*term)[n - 1] - 1e-3 * term->back());

  setup.step.beta = 0.;
  EXPECT_EQ(largest(observe(setup).e.damping), 0.);
  setup.step.beta2 = 0.5;
  EXPECT_EQ(largest(observe(setup).e.scheme), 0.);
  setup.friction = 0.;
  EXPECT_EQ(largest(observe(setup).e.friction), 0.);
}

namespace
{
/** Integrals over time with dense element matrices, v and a by differences of u. */
struct DampingWork : StepObserver
{
  explicit DampingWork(const Body &body)
    : body(body)
  {
  }

  std::uint64_t next_step(const std::uint64_t n) const override
  {
    return n;
  }
  void before_step(const std::uint64_t n) override
  {
    if (n == 0)
      {
        now = body.u;
        for (std::size_t k = 0; k < now.size(); ++k)
          now.begin()[k] -= body.setup.step.dt * body.w.begin()[k];
      }
    before = now;
    now    = body.u;
  }
  void after_step(const std::uint64_t) override
  {
    const double dt      = body.setup.step.dt;
    NodalField<double> v = body.u, a = body.u;
    for (std::size_t k = 0; k < v.size(); ++k)
      {
        v.begin()[k] = (v.begin()[k] - before.begin()[k]) / (2. * dt);
        a.begin()[k] += before.begin()[k] - 2. * now.begin()[k];
        a.begin()[k] /= dt * dt;
      }
    const NodalField<double> f = elasticity_testing::reference_product(body.material, v);
    v_K_v += dt * std::inner_product(f.begin(), f.begin() + f.size(), v.begin(), 0.);
    a_M_a += dt * mass_product(body.material, a, a);
  }

  const Body &body;
  NodalField<double> before, now;
  double v_K_v = 0., a_M_a = 0.;
};
} // namespace

TEST(Energy, DampingIsBetaTimesTheWorkOfTheOperator)
{
  for (const double b : {0.5, 0.6})
    {
      BodySetup setup     = thrown_body(8, 5);
      setup.step.beta     = 3e-8;
      setup.step.beta2    = b;
      setup.top.is_platen = false;
      setup.top.pressure  = LoadHistory();
      setup.contact.gap   = 1.;
      setup.choose_time_step(0.1);
      Body body(setup);
      body.set_w([](const double x, const double y, const unsigned int c) {
        return c == 1 ? std::sin(800. * x) * std::cos(700. * y) : 0.;
      });
      DampingWork reference(body);
      body.run(3000, &reference);
      const EnergyHistory e = body.energy->reduce();
      EXPECT_GT(e.damping.back(), 0.1 * e.initial);
      EXPECT_NEAR(e.damping.back(), setup.step.beta * reference.v_K_v,
                  5e-3 * e.damping.back());
      EXPECT_NEAR(e.scheme.back(), (b - 0.5) * setup.step.dt * reference.a_M_a,
                  0.02 * e.scheme.back());
    }
}

TEST(Energy, ClosesWithSparseSamples)
{
  // A coarse grid of the paper's pin at 5 MPa.
  BodySetup setup;
  setup.cells                 = {{140, 40}};
  setup.spacing               = {{4e-4, 4e-4}};
  setup.classes               = {resin()};
  setup.friction              = 0.25;
  setup.contact.flat_velocity = LoadHistory(V);
  setup.top.pressure          = LoadHistory(P);
  setup.step.beta             = 4.4e-9;
  setup.energy_interval       = 50;
  setup.choose_time_step(0.5);
  Body body(setup);
  const auto n_steps = static_cast<std::uint64_t>(std::lround(1e-3 / setup.step.dt));
  body.run(n_steps);
  const EnergyHistory e = body.energy->reduce();
  EXPECT_EQ(e.time.size(), (n_steps + 49) / 50);
  EXPECT_GT(e.damping.back(), 1e-3 * e.friction.back());
  std::printf("residual %g of the friction work\n",
              largest(e.residual()) / e.friction.back());
  EXPECT_LT(largest(e.residual()), 1e-3 * e.friction.back());
  measured::number("residual over friction", 0.,
                   largest(e.residual()) / e.friction.back());
}

TEST(Momentum, IsWhatTheForcesAtTopAndBottomSay)
{
  for (const bool platen : {true, false})
    for (const bool periodic : {false, true})
      {
        BodySetup setup         = thrown_body();
        setup.periodic          = periodic;
        setup.top.is_platen     = platen;
        setup.top.held          = {{true, true, false}};
        setup.step.acceleration = {{1e5, -2e5}};
        setup.step.beta         = 1e-8;
        setup.choose_time_step(0.9);
        if (platen)
          setup.top.platen_mass = 0.02;
        Body body(setup);
        body.run(2500);
        const ContactHistory &c = body.contact_recorder.history();
        const TopHistory &t     = body.top_recorder.history();
        double x = 0., y = 0., px = 0., py = 0., size = 0.;
        const double mass = body.material.total_mass();
        for (std::size_t n = 0; n < c.time.size(); ++n)
          {
            x += setup.step.dt *
                 (c.tangential_force[n] - t.tangential_force[n] + mass * 1e5);
            y += setup.step.dt * (c.normal_force[n] - t.normal_force[n] - mass * 2e5);
            size += setup.step.dt * t.normal_force[n];
          }
        for (const unsigned int axis : {0U, 1U})
          {
            NodalField<double> unit = body.w;
            unit.set_zero();
            for (unsigned int j = 0; j < unit.n_rows(); ++j)
              std::fill_n(unit.row(axis, j), unit.n_columns() - periodic, 1.);
            (axis == 0 ? px : py) = mass_product(body.material, unit, body.w);
          }
        py += setup.top.platen_mass * body.w.row(1, body.w.n_rows() - 1)[0];
        EXPECT_NEAR(px, x, 1e-12 * size);
        EXPECT_NEAR(py, y, 1e-12 * size);
        EXPECT_GT(std::abs(py), 1e-6 * size);
      }
}
