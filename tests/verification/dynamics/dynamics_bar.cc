#include "../../measured.h"
#include "impact_bar.h"

#include <gtest/gtest.h>

using namespace verification;
using namespace verification::impact_bar;

namespace
{
/** What the numbers of a test are called. */
template <int dim>
std::string named(const std::string &name)
{
  return dim == 2 ? name : name + ", box";
}

template <int dim>
void expect_impact()
{
  const unsigned int n = 400;
  BodyIn<dim> body     = bar_in<dim>(bar(n, 0.5, 0.9));
  throw_down(body);
  const double dt = body.setup.step.dt, width = body.setup.spacing[0] * body.depth;
  body.run(std::lround(2. / dt));
  const ContactHistory &h = body.contact_recorder.history();

  const auto [first, last] = contact_span(h);
  const double impulse =
    dt * std::accumulate(h.normal_force.begin(), h.normal_force.end(), 0.);
  EXPECT_NEAR(first, 0.5, 2. * dt);
  // The front that ends the contact is spread over a few cells.
  EXPECT_NEAR(last, 0.5 + 2. * length / c, 25. * dt);
  EXPECT_NEAR(impulse, 2. * v * length * width, 5e-3 * 2. * v * length * width);

  double pressure        = 0.;
  unsigned int n_samples = 0;
  for (std::size_t k = 0; k < h.time.size(); ++k)
    if (h.time[k] > 0.55 && h.time[k] < 1.1)
      {
        pressure += h.normal_force[k] / width;
        ++n_samples;
      }
  EXPECT_NEAR(pressure / n_samples, c * v, 0.3);
  measured::number(named<dim>("pressure"), c * v, pressure / n_samples);
  measured::number(named<dim>("end of the contact"), 0.5 + 2. * length / c, last);

  double velocity = 0.;
  for (unsigned int j = 0; j <= n; ++j)
    velocity += body.at(body.w, 1, 0, j) / (n + 1);
  EXPECT_NEAR(velocity, v, 0.02 * v);
  measured::number(named<dim>("velocity after"), v, velocity);
  // No lateral motion with nu = 0.
  EXPECT_LT(std::abs(body.at(body.u, 0, 0, n / 2)), 1e-10);
}

template <int dim>
void expect_energy_loss()
{
  std::vector<double> loss, damped_loss;
  for (const unsigned int n : {100, 200, 400})
    {
      const Impact plain  = impact<dim>(bar(n, 0.5, 0.5)),
                   damped = impact<dim>(bar(n, 1., 0.5));
      for (const Impact &i : {plain, damped})
        {
          EXPECT_LT(i.residual, 1e-12);
          EXPECT_TRUE(i.separated);
        }
      loss.push_back(1. - plain.natural);
      damped_loss.push_back(1. - damped.balanced);
      measured::error(named<dim>("loss of an impact, beta2 = 0.5"), n, loss.back());
      measured::error(named<dim>("loss of an impact, beta2 = 1"), n, damped_loss.back());
      std::printf("n = %u: b = 1/2 %.6f %.5f, b = 1 %.5f\n", n, plain.balanced,
                  plain.natural, damped.balanced);
      // What is lost is the kinetic energy of the nodes that land.
      EXPECT_NEAR(plain.balanced, 1. - 0.5 / n, 1e-8);
    }
  EXPECT_NEAR(1. - loss[0], 0.9953, 2e-4);
  EXPECT_NEAR(1. - loss[2], 0.9988, 1e-4);
  EXPECT_NEAR(orders(loss).back(), 1., 0.05);
  measured::number(named<dim>("energy kept, n = 400, beta2 = 0.5"), 0.9988, 1. - loss[2]);
  measured::number(named<dim>("energy kept, n = 400, beta2 = 1"), 0.953,
                   1. - damped_loss[2]);
  EXPECT_NEAR(1. - damped_loss[0], 0.905, 1e-3);
  EXPECT_NEAR(1. - damped_loss[2], 0.953, 1e-3);
  EXPECT_NEAR(orders(damped_loss).back(), 0.5, 0.05);
}

// In the falling frame the flat pushes the lower end by v t + g t^2 / 2, which sends up a
// wave with the pressure rho c (v + g t); its echo comes back at T = 2 L / c, when the
// bar would be pulled: contact from 1 to 1 + T with the impulse rho c (v T + g T^2 / 2).
template <int dim>
void expect_first_bounce()
{
  constexpr double g = 10., T = exact_duration;
  std::vector<double> impulse_errors, pressure_errors;
  for (const unsigned int n : {50, 100, 200, 400})
    {
      BodySetup setup         = bar(n, 0.5, 0.9);
      setup.step.acceleration = {{0., -g}};
      BodyIn<dim> body        = bar_in<dim>(setup);
      const double dt = setup.step.dt, width = setup.spacing[0] * body.depth;
      body.run(std::lround(2.2 / dt));
      const ContactHistory &h = body.contact_recorder.history();
      double impulse = 0., squares = 0., n_samples = 0., after = 0.;
      for (std::size_t k = 0; k < h.time.size(); ++k)
        {
          const double t = h.time[k] - 1., pressure = h.normal_force[k] / width;
          impulse += h.normal_force[k] * dt / width;
          if (t > 0.1 * T && t < 0.9 * T)
            {
              squares += std::pow(pressure - c * (v + g * t), 2);
              n_samples += 1.;
            }
          after += t > 1.1 * T ? pressure : 0.;
        }
      EXPECT_EQ(after, 0.);
      impulse_errors.push_back(impulse - c * (v * T + 0.5 * g * T * T));
      pressure_errors.push_back(std::sqrt(squares / n_samples));
      measured::error(named<dim>("pressure of a bounce under gravity"), n,
                      pressure_errors.back() / (c * v));
      EXPECT_NEAR(impulse_errors.back() / (c * (v * T + 0.5 * g * T * T)), 0., 1e-3);
    }
  for (const double order : orders(pressure_errors))
    EXPECT_NEAR(order, 1., 0.05);
  EXPECT_LT(pressure_errors.back(), 1e-3 * c * v);
  EXPECT_LT(std::abs(impulse_errors.back()), 0.1 * std::abs(impulse_errors.front()));
}

} // namespace

TEST(Bar, HitsTheWallAndLeaves)
{
  expect_impact<2>();
}

TEST(Bar, EnergyLossOfOneImpact)
{
  expect_energy_loss<2>();
}

TEST(Bar, FirstBounceUnderGravity)
{
  expect_first_bounce<2>();
}

TEST(BoxBar, HitsTheWallAndLeaves)
{
  expect_impact<3>();
}

TEST(BoxBar, EnergyLossOfOneImpact)
{
  expect_energy_loss<3>();
}

TEST(BoxBar, FirstBounceUnderGravity)
{
  expect_first_bounce<3>();
}

TEST(Bar, BouncingUnderGravityGainsNoEnergy)
{
  for (const double b : {0.5, 0.8})
    {
      BodySetup setup         = bar(100, b, b == 0.5 ? 0.95 : 0.6);
      setup.step.acceleration = {{0., -10.}};
      Body body(setup);
      body.run(std::lround(20. / setup.step.dt));
      const EnergyHistory e = body.energy->reduce();
      // From the drop height: m g gap.
      const double scale = setup.spacing[0] * length * 10. * 5.;
      EXPECT_LT(largest(e.residual()), 1e-11 * scale);
      for (std::size_t n = 1; n < e.time.size(); ++n)
        {
          ASSERT_LE(mechanical(e, n), mechanical(e, n - 1) + 1e-11 * scale) << n;
          ASSERT_GE(e.impact[n], e.impact[n - 1] - 1e-11 * scale) << n;
        }
      EXPECT_GT(e.impact.back(), 1e-3 * scale);
      const auto &h = body.contact_recorder.history();
      body.node_statistics.finish(body.contact);
      // The first drop takes 1 s; then it bounces.
      std::size_t k = 0;
      while (h.normal_force[k] == 0.)
        ++k;
      EXPECT_NEAR(h.time[k], 1., 2. * setup.step.dt);
      EXPECT_GT(body.node_statistics.blocks()[0].landings[0], 4.f);
    }
}

namespace
{
/** Largest error of the pressure of a bar that is thrown on a wall of this stiffness (Pa/m) over rho c v, until the wave
 * is back: p = rho c v (1 - exp(-k t / (rho c))). */
template <int dim>
double error_on_soft_wall(const unsigned int n_cells, const double stiffness)
{
  constexpr double Z = 1. * c, start = 0.5;
  BodySetup setup                       = bar(n_cells, 0.5, 0.95);
  setup.contact.normal_spring.stiffness = stiffness;
  auto body                             = bar_in<dim>(setup);
  throw_down(body);
  body.run(std::lround((start + 0.9 * exact_duration) / setup.step.dt));
  const ContactHistory &h = body.contact_recorder.history();
  double worst            = 0.;
  for (std::size_t k = 0; k < h.time.size(); ++k)
    {
      const double since = std::max(0., h.time[k] - start),
                   exact = 1. - std::exp(-stiffness * since / Z),
                   found = h.normal_force[k] / (setup.spacing[0] * body.depth * Z * v);
      worst              = std::max(worst, std::fabs(found - exact));
    }
  return worst;
}

// The pressure begins with a kink, so that the order is one.
template <int dim>
void expect_soft_impact()
{
  const double coarse = error_on_soft_wall<dim>(100, 300.),
               fine   = error_on_soft_wall<dim>(200, 300.);
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(std::log2(coarse / fine), 0.9);
  measured::error(dim == 2 ? "bar on a soft wall" : "bar on a soft wall, box", 100,
                  coarse);
  measured::error(dim == 2 ? "bar on a soft wall" : "bar on a soft wall, box", 200, fine);
}
} // namespace

TEST(Bar, HitsASoftWall)
{
  expect_soft_impact<2>();
  expect_soft_impact<3>();
}

// Stiffer and stiffer walls are the rigid one: the energy that the impact keeps differs by a share that falls with 1/k.
TEST(Bar, HitsAWallThatIsAsGoodAsRigid)
{
  const auto kept = [](const double stiffness) {
    BodySetup setup                       = bar(100, 0.5, 0.95);
    setup.contact.normal_spring.stiffness = stiffness;
    Body body(setup);
    throw_down(body);
    body.run(std::lround(1.5 / setup.step.dt));
    const EnergyHistory e = body.energy->reduce();
    EXPECT_LT(largest(e.residual()), 1e-12 * e.initial);
    return mechanical(e, e.time.size() - 1) / e.initial;
  };
  const double rigid   = kept(std::numeric_limits<double>::infinity()),
               stiff   = std::fabs(kept(1e7) - rigid),
               stiffer = std::fabs(kept(1e8) - rigid);
  EXPECT_LT(stiff, 1e-3);
  EXPECT_LT(stiffer, 0.2 * stiff);
}
