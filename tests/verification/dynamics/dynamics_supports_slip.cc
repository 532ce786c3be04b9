#include "contact/laws/slip_weakening.h"
#include "supports_column.h"

namespace supports
{
namespace
{
/** A two-phase body that sticks, slips and bounces under these supports. */
template <int dim>
void expect_closed(BodySetup s, const std::string &what)
{
  s.cells                 = {{11, 7}};
  s.spacing               = {{5e-4, 4e-4}};
  s.classes               = {column_material<2>()};
  s.friction              = 0.4;
  s.contact.flat_velocity = LoadHistory(2.);
  s.contact.gap           = 2e-7;
  s.top.pressure          = LoadHistory(5e6);
  s.energy_interval       = 1;
  s.step.dt               = 4e-8;
  s.step.alpha            = 3e3;
  s.step.beta             = 2e-9;
  s.step.acceleration     = {{2e3, -1e4, 0.}};
  for (const double beta2 : {0.5, 0.8})
    {
      s.step.beta2     = beta2;
      BodyIn<dim> body = make_body<dim>(s, {column_material<3>(), 3, 0.});
      body.set_w([](const double x, const double y, const unsigned int c) {
        return c == 1 ? -1.5 + 0.3 * std::sin(900. * x + 400. * y) : 0.2;
      });
      // A platen moves as one from the start.
      if (s.top.is_platen)
        body.set_w(
          [](double, double, const unsigned int c) { return c == 1 ? -1.5 : 0.; });
      body.run(3000);
      const EnergyHistory e = body.energy->reduce();
      double scale          = 0.;
      for (const auto *values : {&e.kinetic, &e.elastic, &e.external_work, &e.supports})
        scale = std::max(scale, largest(*values));
      EXPECT_LT(largest(e.residual()), 1e-12 * scale) << what << beta2;
      EXPECT_GT(e.dashpots.back(), 1e-4 * scale) << what << beta2;
      EXPECT_GT(e.friction.back(), 1e-4 * scale) << what << beta2;
      for (std::size_t k = 1; k < e.dashpots.size(); ++k)
        ASSERT_GE(e.dashpots[k] - e.dashpots[k - 1], -1e-13 * scale)
          << what << " at " << k;
    }
}

template <int dim>
void expect_all_closed()
{
  BodySetup s;
  Suspension &on  = s.top.suspension;
  s.top.is_platen = false;
  on.stiffness    = {{3e11, 1e12, 1e12}};
  on.dashpot      = {{1e6, 3e6, 3e6}};
  on.motion[0]    = LoadHistory(1., "1e-6*sin(2e5*t)+1e-7");
  on.motion[1]    = LoadHistory(1., "2e-7*cos(3e5*t)");
  expect_closed<dim>(s, "springs");
  on.mass = 2.;
  expect_closed<dim>(s, "springs with mass");
  on.mass           = 0.;
  s.top.is_platen   = true;
  s.top.platen_mass = 1e-2;
  expect_closed<dim>(s, "platen on springs");
  on                = {};
  on.absorbing      = true;
  s.top.is_platen   = false;
  s.top.platen_mass = 0.;
  const auto Z      = impedance<dim>(column_material<dim>().stiffness, rho);
  for (unsigned int k = 0; k < dim * dim; ++k)
    s.top.nodes.impedance.emplace_back(dim == 2 ? 12 : 12 * 4, Z(k / dim, k % dim));
  expect_closed<dim>(s, "absorbing");
}
} // namespace

TEST(Supports, EnergyCloses)
{
  expect_all_closed<2>();
  expect_all_closed<3>();
}
namespace
{
/** Extremes of the force of the spring over the area (Pa) and period (s) of stick and slip. */
struct StickSlip
{
  double least = HUGE_VAL, most = 0., period = 0.;
};

/** A column under a platen that a spring holds, while either the flat or the far end moves with @p speed (m/s). */
StickSlip pulled(const double critical_slip, const double kinetic, const bool far_end)
{
  constexpr double speed = 0.05, height = 4e-3, mass = 100.;
  BodySetup s        = column(8, height);
  s.energy_interval  = 0;
  s.history_interval = 20;
  s.contact.gap      = 0.;
  s.friction         = 0.3;
  s.contact.law.time = 0.;
  s.contact.law.coefficient_law =
    std::make_shared<SlipWeakening>(SlipWeakening::Constants{
      0.3, kinetic, critical_slip, false, {Healing::Kind::sticking, 0.}});
  s.contact.law.reference    = 0.3;
  s.top.is_platen            = true;
  s.top.platen_mass          = mass * s.spacing[0];
  s.top.pressure             = LoadHistory(1e6, Ramp::smooth, 1e-4);
  s.top.suspension.stiffness = {{1e9, 0., 0.}};
  if (far_end)
    s.top.suspension.motion[0] = LoadHistory(1., "0.05*t");
  else
    s.contact.flat_velocity = LoadHistory(speed);
  s.step.beta = 2e-7;
  s.choose_time_step(0.9);
  Body body(s);
  body.run(std::lround(0.022 / s.step.dt));
  const TopHistory &top = body.top_recorder.history();
  const double sign     = far_end ? -1. : 1.;
  StickSlip found;
  double before = 0., passed = 0.;
  for (std::size_t k = top.tangential_force.size() * 2 / 5;
       k < top.tangential_force.size(); ++k)
    {
      const double traction = sign * top.tangential_force[k] / s.spacing[0],
                   t        = k * s.history_interval * s.step.dt;
      found.least           = std::min(found.least, traction);
      found.most            = std::max(found.most, traction);
      if (before < 0.25e6 && traction >= 0.25e6 && before > 0.)
        {
          found.period = passed > 0. ? t - passed : 0.;
          passed       = t;
        }
      before = traction;
    }
  return found;
}
} // namespace

// While it sticks the spring is stretched by V t, then the block swings about mu_k p; the slower friction falls with the
// slip, the later. One coefficient: it slides steadily. Whether flat or far end moves is the same.
TEST(Supports, BlockOnASpringSticksAndSlips)
{
  constexpr double k = 1e9, p = 1e6, V = 0.05, drop = 0.1 * p;
  const double mass = 100. + rho * 4e-3, omega = std::sqrt(k / mass),
               amplitude = std::hypot(drop, k * V / omega),
               period    = 2. * drop / (k * V) +
                        2. / omega * (M_PI - std::atan(drop * omega / (k * V)));
  std::vector<double> errors;
  for (const double critical_slip : {1e-6, 1e-7, 1e-8})
    {
      const StickSlip found = pulled(critical_slip, 0.2, false);
      errors.push_back(std::fabs(found.period / period - 1.));
      EXPECT_NEAR(found.least + found.most, 2. * 0.2 * p, 1e-3 * p);
      if (critical_slip > 1e-8)
        continue;
      EXPECT_NEAR(found.most - found.least, 2. * amplitude, 0.01 * amplitude);
      measured::number("stick and slip: jump of the force (MPa)", 2e-6 * amplitude,
                       1e-6 * (found.most - found.least));
      measured::number("stick and slip: period (ms)", 1e3 * period, 1e3 * found.period);
      const StickSlip same = pulled(critical_slip, 0.2, true);
      EXPECT_NEAR(same.period, found.period, 2e-3 * period);
      EXPECT_NEAR(same.most, found.most, 2e-3 * found.most);
    }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
  EXPECT_LT(errors[2], 0.5 * errors[1]);
  EXPECT_LT(errors[2], 6e-3);
  // What swings from the start on, with the speed of the flat at most, has nothing that damps it.
  const StickSlip steady = pulled(1e-8, 0.3, false);
  EXPECT_NEAR(steady.least, 0.3 * p - k * V / omega, 1e-3 * p);
  EXPECT_NEAR(steady.most, 0.3 * p + k * V / omega, 1e-3 * p);
  EXPECT_EQ(steady.period, 0.);
}
} // namespace supports
