#include "../../measured.h"
#include "../sliding/sliding_body.h"

#include <gtest/gtest.h>

using namespace verification;

namespace tangential
{
namespace
{
constexpr double H = 4e-3, G = 13.785e9, rho = 1770., P = 5e6, k_t = 5e12;

/** A periodic column without Poisson's ratio, pressed on the flat and held along it at its top. */
BodySetup column(const unsigned int n, const double friction)
{
  BodySetup setup;
  setup.cells                        = {{1, n}};
  setup.spacing                      = {{H / n, H / n}};
  VoigtMatrix<2> D                   = isotropic_stiffness<2>(2. * G, 0.);
  setup.classes                      = {{D, rho}};
  setup.ids                          = std::vector<std::uint8_t>(n, 0);
  setup.periodic                     = true;
  setup.friction                     = friction;
  setup.contact.law.time             = 0.;
  setup.contact.tangential_stiffness = k_t;
  setup.top.is_platen                = false;
  setup.top.pressure                 = LoadHistory(P);
  setup.top.held                     = {{true, true, false}};
  setup.energy_interval              = 1;
  return setup;
}

double compressed(const BodySetup &setup, const double y)
{
  return -P / setup.classes[0].stiffness(1, 1) * y;
}
} // namespace

// sin(q (H - y)) with tan(q H) = -q G / k_t, which friction only lets swing.
TEST(TangentialSprings, ColumnVibratesOnThem)
{
  double q = 0.75 * M_PI / H;
  for (unsigned int n = 0; n < 50; ++n)
    q = (M_PI - std::atan(q * G / k_t)) / H;
  EXPECT_NEAR(std::tan(q * H), -q * G / k_t, 1e-9);
  EXPECT_GT(q * H, 0.55 * M_PI);
  EXPECT_LT(q * H, 0.95 * M_PI);
  const double due = q * std::sqrt(G / rho) / (2. * M_PI);
  std::vector<double> errors, lost;
  for (const unsigned int n : {8, 16, 32, 64})
    {
      BodySetup setup = column(n, 10.);
      setup.choose_time_step(0.9);
      Body body(setup);
      body.set_u([&](const double, const double y, const unsigned int c) {
        return c == 1 ? compressed(setup, y) : 0.;
      });
      body.set_w([&](const double, const double y, const unsigned int c) {
        return c == 0 ? 1e-3 * std::sin(q * (H - y)) : 0.;
      });
      // From one passage through zero to the fifth after it.
      std::vector<double> passages;
      double before = 0.;
      for (std::uint64_t m = 1; passages.size() < 6; ++m)
        {
          body.run(1);
          const double now = body.at(body.u, 0, 0, n / 2);
          if (m > 2 && before * now < 0.)
            passages.push_back(setup.step.dt * (m - now / (now - before)));
          before = now;
        }
      const double found = 2.5 / (passages.back() - passages.front());
      std::printf("H/%u: %.3f Hz (exact %.3f)\n", n, found, due);
      errors.push_back(std::fabs(found / due - 1.));
      measured::number("frequency of a column on springs along the flat (Hz)", due,
                       found);
      const EnergyHistory e = body.energy->reduce();
      lost.push_back(e.friction.back() / largest(e.kinetic));
    }
  // What the scheme takes from springs that hold.
  EXPECT_NEAR(std::log2(lost[1] / lost[2]), 3., 0.2);
  EXPECT_NEAR(std::log2(lost[2] / lost[3]), 3., 0.2);
  EXPECT_LT(errors[2], 1e-3);
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2., 0.4);
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2., 0.4);
}

// A flat that goes slowly to and fro by D takes 4 mu P (D - mu P (1/k_t + H/G)) from each period and area.
TEST(TangentialSprings, LoopOfSlowSlidingHasItsArea)
{
  constexpr double mu = 0.3, D = 2e-6, period = 4e-4;
  BodySetup setup             = column(8, mu);
  setup.step.beta             = 1e-7;
  setup.contact.flat_velocity = LoadHistory(1., "2*pi*2e-6/4e-4*cos(2*pi*t/4e-4)");
  setup.choose_time_step(0.9);
  Body body(setup);
  body.set_u([&](const double, const double y, const unsigned int c) {
    return c == 1 ? compressed(setup, y) : 0.;
  });
  const auto lost = [&]() {
    const EnergyHistory e = body.energy->reduce();
    return e.friction.back();
  };
  const std::uint64_t steps = std::lround(period / setup.step.dt);
  body.run(steps);
  const double before = lost();
  body.run(steps);
  const double found = (lost() - before) / setup.spacing[0],
               due   = 4. * mu * P * (D - mu * P * (1. / k_t + H / G));
  EXPECT_GT(due, 0.5 * 4. * mu * P * D);
  EXPECT_NEAR(found, due, 5e-3 * due) << found / due;
  measured::number("loss of a period of sliding to and fro on springs (J/m^2)", due,
                   found);
}
} // namespace tangential
