// Sentences on stiffnesses and other input that is not likely to be meant.

#include "material/plausibility.h"
#include "material/stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace mesoslip;

TEST(Plausibility, ModuliInOtherUnits)
{
  const auto warning = [](const double matrix, const double fibre) {
    return stiffness_warning<2>({{"matrix", isotropic_stiffness<2>(matrix, 0.)},
                                 {"fibre", isotropic_stiffness<2>(fibre, 0.)}});
  };
  EXPECT_EQ(warning(30e9, 240e9), "");
  EXPECT_EQ(warning(1e6, 1e12), ""); // a million times, and rubber
  EXPECT_EQ(warning(30e9, 240.),
            "phase 'matrix' is 1.25e+08 times as stiff as phase 'fibre'; is "
            "one of them in GPa or MPa? Moduli are in Pa");
  EXPECT_EQ(warning(240e3, 30e3),
            "phase 'fibre' has a stiffness of 3e+04 Pa, less than soft "
            "rubber; is it in GPa or MPa? Moduli are in Pa");
  EXPECT_EQ(stiffness_warning<2>({}), "");
}

TEST(Plausibility, ValuesOutsideTheirRanges)
{
  const auto sentences = [](const double value) {
    return implausible({{"Top/Pressure", value, "Pa", 1., "too low", 2., "too high"}});
  };
  EXPECT_TRUE(sentences(1.).empty());
  EXPECT_TRUE(sentences(2.).empty());
  ASSERT_EQ(sentences(0.5).size(), 1u);
  EXPECT_EQ(sentences(0.5)[0], "Top/Pressure is 0.5 Pa, too low");
  EXPECT_EQ(sentences(2.00001234).at(0), "Top/Pressure is 2 Pa, too high");
  EXPECT_EQ(sentences(std::nan("")).at(0), "Top/Pressure is nan Pa, too low");

  const auto found = [](const double density, const double coefficient) {
    return implausible(plausible_phases<2>(
                         {{"a", isotropic_stiffness<2>(1e9, 0.), density, coefficient}}))
      .size();
  };
  EXPECT_EQ(found(1770., 0.25), 0u);
  EXPECT_EQ(found(0., 0.), 0u) << "a density that is not given";
  EXPECT_EQ(found(22590., 2.), 0u) << "osmium";
  EXPECT_EQ(found(1.77, 25.), 2u);
  EXPECT_EQ(found(1.77e6, 0.), 1u);
}
