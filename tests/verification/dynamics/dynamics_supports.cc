#include "../../measured.h"
#include "../sliding/box_body.h"
#include "contact/laws/slip_weakening.h"
#include "material/plausibility.h"
#include "material/shear_impedance.h"

#include <gtest/gtest.h>

using namespace verification;

namespace supports
{
namespace
{
constexpr double H = 0.016, rho = 1770., D22 = 47.26e9, D33 = 13.785e9;
const double c_p = std::sqrt(D22 / rho), c_s = std::sqrt(D33 / rho);
const double Z_p = rho * c_p, Z_s = rho * c_s;

/** Waves along the normal have the speeds c_p and c_s, and do not mix. */
template <int dim>
ElasticPhase<dim> column_material()
{
  VoigtMatrix<dim> D = rho * c_s * c_s * VoigtMatrix<dim>::Identity();
  for (unsigned int k = 0; k < dim; ++k)
    D(k, k) = rho * c_p * c_p;
  return {D, rho};
}

/** One column of cells of height @p height, free of the flat. */
BodySetup column(const unsigned int n, const double height = H)
{
  BodySetup s;
  s.cells           = {{1, n}};
  s.spacing         = {{height / n, height / n}};
  s.classes         = {column_material<2>()};
  s.periodic        = true;
  s.contact.gap     = 1.;
  s.top.is_platen   = false;
  s.top.pressure    = LoadHistory(0.);
  s.energy_interval = 1;
  return s;
}

/** A column that vibrates as u = a cos(omega y / c) cos(omega t) + what its top asks for. */
struct Vibration
{
  unsigned int component; ///< 0: shear
  double omega;           ///< 1/s
  double amplitude = 1e-6;
};

/** Smallest root of Z omega tan(omega H / c) = k - m omega^2. */
double frequency_on_springs(const unsigned int component, const double k, const double m)
{
  const double c = component == 0 ? c_s : c_p;
  double low = 0., high = 0.5 * M_PI * c / H * (1. - 1e-12);
  for (unsigned int n = 0; n < 200; ++n)
    {
      const double omega = 0.5 * (low + high);
      (rho * c * omega * std::tan(omega * H / c) < k - m * omega * omega ? low : high) =
        omega;
    }
  return low;
}

/** Largest error of u over its amplitude after three quarters of a period, where errors of the frequency
 * count most. */
template <int dim>
double error_of(BodySetup setup, const Vibration &vibration)
{
  const double c = vibration.component == 0 ? c_s : c_p, omega = vibration.omega,
               end          = 1.5 * M_PI / omega;
  const auto n              = setup.cells[1];
  const std::uint64_t steps = std::ceil(end * c_p / (0.6 * H / n));
  setup.step.dt             = end / steps;
  BodyIn<dim> body          = make_body<dim>(setup, {column_material<3>(), 1, 0.6});
  const auto shape          = [&](const double y, const unsigned int k) {
    return k == vibration.component ? vibration.amplitude * std::cos(omega * y / c) : 0.;
  };
  body.set_u([&](double, const double y, const unsigned int k) { return shape(y, k); });
  body.set_w([&](double, const double y, const unsigned int k) {
    return setup.step.beta2 * setup.step.dt * omega * omega * shape(y, k);
  });
  body.run(steps);
  double worst = 0.;
  for (unsigned int j = 0; j <= n; ++j)
    for (unsigned int k = 0; k < 2; ++k)
      worst = std::max(worst, std::fabs(body.at(body.u, k, 0, j)));
  const EnergyHistory e = body.energy->reduce();
  EXPECT_LT(largest(e.residual()), 1e-12 * e.initial);
  return worst / vibration.amplitude;
}

/** The error falls with order two on 10, 20 and 40 cells, to @p finest at most; it is recorded as a @p series. */
template <typename Error>
void expect_order_two(const Error &error,
                      const double finest,
                      const std::string &what,
                      const bool series = true)
{
  std::vector<double> errors;
  for (const unsigned int n : {10U, 20U, 40U})
    {
      errors.push_back(error(n));
      if (series)
        measured::error(what, n, errors.back());
    }
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8) << what;
  EXPECT_GT(std::log2(errors[1] / errors[2]), 1.9) << what;
  EXPECT_LT(errors[2], finest) << what;
}
} // namespace

// omega Z tan(omega H / c) = k - m omega^2: each node on springs with a mass, and a platen on springs.
TEST(Supports, ColumnOnSpringsHasItsFrequency)
{
  for (const unsigned int component : {0U, 1U})
    for (const double stiffness : {1e11, 1e12})
      for (const double mass : {0., 8.})
        {
          const double omega = frequency_on_springs(component, stiffness, mass);
          const auto setup   = [&](const unsigned int n, const bool platen,
                                 const unsigned int dim) {
            BodySetup s     = column(n);
            s.top.is_platen = platen;
            Suspension &on  = s.top.suspension;
            if (component == 0)
              on.stiffness[0] = on.stiffness[dim - 2] = stiffness;
            else
              on.stiffness[dim - 1] = stiffness;
            if (!platen)
              on.mass = mass;
            else
              s.top.platen_mass = mass * s.spacing[0] * (dim == 3 ? s.spacing[0] : 1.);
            return s;
          };
          const std::string what = brief_text(3, component == 0 ? "S" : "P", " on ",
                                              stiffness, " Pa/m with ", mass, " kg/m^2");
          for (const bool platen : {false, true})
            {
              const std::string top = platen ? ", platen" : "";
              expect_order_two(
                [&](const unsigned int n) {
                  return error_of<2>(setup(n, platen, 2), {component, omega});
                },
                2e-3, "column: " + what + top, stiffness == 1e12 && mass > 0.);
              expect_order_two(
                [&](const unsigned int n) {
                  return error_of<3>(setup(n, platen, 3), {component, omega});
                },
                2e-3, "box: " + what + top, false);
            }
        }
}

// As shares of the frequencies of the clamped column, 80.74 and 43.61 kHz.
TEST(Supports, FrequenciesOfTheFormulaAreThoseGiven)
{
  const auto share = [](const unsigned int component, const double k) {
    const double c = component == 0 ? c_s : c_p;
    return frequency_on_springs(component, k, 0.) / (0.5 * M_PI * c / H);
  };
  EXPECT_NEAR(share(1, 1e12), 0.3508, 5e-5);
  EXPECT_NEAR(share(0, 1e12), 0.5776, 5e-5);
  EXPECT_NEAR(share(1, 1e15), 0.9971, 5e-5);
  EXPECT_NEAR(share(0, 1e15), 0.9991, 5e-5);
}

namespace
{
/** Share of the energy of a pulse that comes back from the top of a long column, of @p n cells a wave length. */
template <int dim>
double reflected(BodySetup setup,
                 const ElasticPhase<3> &solid,
                 const std::array<double, 2> &direction,
                 const double c,
                 const double wave)
{
  const double h = setup.spacing[1], height = h * setup.cells[1], middle = 0.5 * height;
  setup.step.dt    = 0.5 * h / c_p;
  BodyIn<dim> body = make_body<dim>(setup, {solid, 1, 0.6});
  const auto pulse = [&](const double y) {
    const double x = (y - middle) / wave;
    return 1e-6 * std::exp(-x * x) * std::cos(2. * M_PI * x);
  };
  // Up it goes: u(y - c t).
  const double dt = setup.step.dt;
  body.set_u([&](double, const double y, const unsigned int k) {
    return direction[k] * pulse(y);
  });
  body.set_w([&](double, const double y, const unsigned int k) {
    return direction[k] * (pulse(y) - pulse(y + c * dt)) / dt;
  });
  body.run(std::lround(0.95 * height / c / dt));
  const EnergyHistory e = body.energy->reduce();
  EXPECT_LT(largest(e.residual()), 1e-12 * e.initial);
  EXPECT_NEAR(e.dashpots.back(), e.initial - e.kinetic.back() - e.elastic.back(),
              1e-9 * e.initial);
  return (e.kinetic.back() + e.elastic.back()) / e.initial;
}
} // namespace

// A dashpot z on waves of impedance Z sends back ((Z - z) / (Z + z))^2 of their energy, and nothing at z = Z.
TEST(Supports, DashpotsReflectByTheirImpedance)
{
  constexpr double wave = 2e-3;
  for (const double share : {0.2, 1., 3.})
    for (const unsigned int component : {0U, 1U})
      {
        const double c = component == 0 ? c_s : c_p, R = (1. - share) / (1. + share);
        const auto setup = [&](const unsigned int n, const unsigned int dim) {
          BodySetup s    = column(n * 10, 10. * wave);
          Suspension &on = s.top.suspension;
          if (component == 0)
            on.dashpot[0] = on.dashpot[dim - 2] = share * Z_s;
          else
            on.dashpot[dim - 1] = share * Z_p;
          return s;
        };
        const std::array<double, 2> direction = {
          {component == 0 ? 1. : 0., 1. * component}};
        const auto error = [&](const unsigned int n) {
          return std::fabs(
            reflected<2>(setup(n, 2), column_material<3>(), direction, c, wave) - R * R);
        };
        EXPECT_LT(error(30), share == 1. ? 1e-3 : 3e-3) << share << component;
        EXPECT_LT(error(60), 0.3 * error(30) + 1e-12) << share << component;
        EXPECT_LT(
          std::fabs(reflected<3>(setup(30, 3), column_material<3>(), direction, c, wave) -
                    R * R),
          share == 1. ? 1e-3 : 3e-3)
          << share << component;
        measured::number(brief_text(3, "energy from a dashpot of ", share, " Z, ",
                                    component == 0 ? "S" : "P"),
                         R * R, R * R + error(60));
      }
}

// In a solid whose axes are turned both waves move along and across; the impedances of the half-space absorb both.
TEST(Supports, TurnedSolidsAreAbsorbed)
{
  constexpr double wave = 2e-3;
  VoigtMatrix<2> D;
  D << 60e9, 10e9, 12e9, 10e9, 20e9, 6e9, 12e9, 6e9, 14e9;
  const auto Z = impedance<2>(D, rho);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> waves(Z);
  for (const int w : {0, 1})
    {
      const Eigen::Vector2d mode = waves.eigenvectors().col(w);
      const double c             = waves.eigenvalues()[w] / rho;
      BodySetup s                = column(300, 10. * wave);
      s.classes                  = {{D, rho}};
      s.top.suspension.absorbing = true;
      for (unsigned int k = 0; k < 4; ++k)
        s.top.nodes.impedance.emplace_back(2, Z(k / 2, k % 2));
      const double share =
        reflected<2>(s, column_material<3>(), {{mode[0], mode[1]}}, c, wave);
      EXPECT_LT(share, 1e-3) << c;
      s.top.suspension.absorbing = false;
      s.top.suspension.dashpot   = {{Z(0, 0), Z(1, 1), 0.}};
      EXPECT_GT(reflected<2>(s, column_material<3>(), {{mode[0], mode[1]}}, c, wave),
                10. * share)
        << c;
    }
}

// Far end and body move alike: nothing is stretched, nothing slides, from the first step on.
TEST(Supports, MovesWithItsFarEnd)
{
  BodySetup s    = column(8);
  Suspension &on = s.top.suspension;
  on.stiffness   = {{1e12, 1e12, 0.}};
  on.dashpot     = {{1e6, 1e6, 0.}};
  on.mass        = 3.;
  on.motion[0]   = LoadHistory(1., "3*t");
  on.motion[1]   = LoadHistory(1., "-0.5*t");
  s.step.dt      = 0.5 * s.spacing[0] / c_p;
  for (const bool platen : {false, true})
    {
      s.top.is_platen = platen;
      Body body(s);
      body.set_initial_velocity({{3., -0.5, 0.}});
      body.run(1000);
      const double t = 1000 * s.step.dt;
      for (unsigned int j = 0; j <= 8; ++j)
        {
          EXPECT_NEAR(body.u.row(0, j)[0], 3. * t, 1e-11 * 3. * t);
          EXPECT_NEAR(body.u.row(1, j)[0], -0.5 * t, 1e-11 * t);
        }
    }
}

// A body that is thrown on dashpots far beyond its impedance: they stop its top within a step, whatever they are, and the
// energy of the throw is all that there is.
TEST(Supports, StiffDashpotsAreHolds)
{
  for (const bool platen : {false, true})
    for (const double dashpot : {1e12, 1e14})
      {
        BodySetup s                = column(20);
        s.top.is_platen            = platen;
        s.top.suspension.dashpot   = {{dashpot, dashpot, 0.}};
        s.top.suspension.stiffness = {{1e9, 0., 0.}};
        s.step.dt                  = 0.5 * s.spacing[0] / c_p;
        Body body(s), held([&]() {
          BodySetup of_held = s;
          of_held.top.hold();
          of_held.top.suspension = {};
          return of_held;
        }());
        for (Body *some : {&body, &held})
          {
            some->set_initial_velocity({{0.3, -1., 0.}});
            some->run(500);
          }
        const EnergyHistory e = body.energy->reduce();
        const double thrown   = 0.5 * rho * H * s.spacing[0] * 1.09;
        EXPECT_NEAR(e.initial, thrown, 0.1 * thrown) << dashpot;
        EXPECT_LT(largest(e.residual()), 1e-24 * dashpot * thrown) << dashpot;
        EXPECT_LT(relative_difference(held.u, body.u), 1e-3) << dashpot;
      }
}

// u = a cos(omega y / c) cos(omega t) with a (k cos(omega H / c) - Z omega sin(omega H / c)) = k X.
TEST(Supports, FarEndDrivesTheColumn)
{
  constexpr double omega = 1.1e5, k = 1e12, a = 1e-6;
  for (const unsigned int component : {0U, 1U})
    {
      const double c = component == 0 ? c_s : c_p, angle = omega * H / c,
                   X   = a * (std::cos(angle) - rho * c * omega * std::sin(angle) / k);
      const auto error = [&](const unsigned int n) {
        BodySetup s                           = column(n);
        s.top.suspension.stiffness[component] = k;
        s.top.suspension.motion[component]    = LoadHistory(
             1., std::to_string(1e6 * X) + "e-6*cos(" + std::to_string(omega) + "*t)");
        return error_of<2>(s, {component, omega, a});
      };
      expect_order_two(error, 5e-3,
                       component == 0 ? "driven column, S" : "driven column, P");
    }
}

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
  BodySetup s                = column(8, height);
  s.energy_interval          = 0;
  s.history_interval         = 20;
  s.contact.gap              = 0.;
  s.friction                 = 0.3;
  s.contact.law.time         = 0.;
  s.contact.law.slip_law     = std::make_shared<SlipWeakening>(SlipWeakening::Constants{
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
