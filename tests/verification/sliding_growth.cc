#include "sliding_layer.h"

#include "../measured.h"

#include <cstdio>
#include <gtest/gtest.h>

using namespace verification;
using namespace verification::sliding_layer;

namespace
{
void expect_growth(const Layer &layer, const double growth, const double frequency)
{
  const Complex s = layer.fastest();
  EXPECT_NEAR(s.real(), growth, 2e-3);
  EXPECT_NEAR(std::abs(s.imag()) / (2. * M_PI), frequency, 2e-3);

  std::vector<double> errors, law_errors;
  for (const unsigned int n : {20, 40, 80})
    {
      const BodySetup setup = layer_setup(layer, n);
      const Growth seen     = observed(setup, layer, s);
      EXPECT_TRUE(seen.slipping);
      const Complex found = seen.rate;
      Layer discrete      = layer;
      discrete.dt         = setup.step.dt;
      const Complex exact = discrete.root(s);
      errors.push_back(std::abs(found - exact));
      law_errors.push_back(std::abs(exact - s));
      const std::string law = layer.delta > 0. ? "regularized" : "Coulomb";
      measured::error("growth, " + law, n, errors.back() / std::abs(s));
      if (layer.delta > 0.)
        measured::error("growth, the law in time", n, law_errors.back() / std::abs(s));
      std::printf(
        "H/%u: growth %.1f 1/s at %.2f Hz; error %.5f %% of s, of the law %.5f %%\n", n,
        found.real(), std::abs(found.imag()) / (2. * M_PI),
        100. * errors.back() / std::abs(s), 100. * law_errors.back() / std::abs(s));
      if (n == 80)
        {
          EXPECT_NEAR(found.real(), s.real(), 0.01 * s.real());
          measured::number("growth (1/s), H/80", growth, found.real());
          measured::number("frequency (Hz), H/80", frequency,
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
} // namespace

TEST(Growth, Coulomb)
{
  expect_growth({1.15, 0.25, 0., 0.}, 30030.410, 49264.050);
}

TEST(Growth, RegularizedAndDamped)
{
  expect_growth({1., 0.25, 1.5e-6, 4.4e-9}, 23574.532, 45632.343);
}
