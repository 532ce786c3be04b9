// Sentences on stiffnesses and other input that is not likely to be meant.

#include "material/plausibility.h"
#include "material/stiffness.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace mesoslip;

TEST(Plausibility, ModuliInOtherUnits)
{
  const auto warning = [](const double matrix, const double fibre) {
    return unit_warning<2>({{"matrix", isotropic_stiffness<2>(matrix, 0.)},
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
  EXPECT_TRUE(stiffness_warnings<2>({}, {}).empty());
}

// Whatever the phase is given by; a stiff direction is no small compressibility.
TEST(Plausibility, LinearCellsLockInNearlyIncompressiblePhases)
{
  const CellKinds fully_integrated = {MeanDilatation::never, false}, as_usual = {},
                  simplices = {MeanDilatation::automatic, true};
  const auto told = [&](const VoigtMatrix<2> &plane, const VoigtMatrix<3> &solid) {
    const auto of_plane = locking_warnings<2>({{"rubber", plane}}, fully_integrated),
               of_solid = locking_warnings<3>({{"rubber", solid}}, fully_integrated);
    EXPECT_TRUE(locking_warnings<2>({{"rubber", plane}}, as_usual).empty());
    EXPECT_EQ(locking_warnings<3>({{"rubber", solid}}, simplices).size(),
              of_solid.size());
    EXPECT_EQ(of_plane, of_solid);
    return of_plane.empty() ? std::string() : of_plane[0];
  };
  const auto isotropic = [&](const double nu) {
    return told(isotropic_stiffness<2>(3e6, nu), isotropic_stiffness<3>(3e6, nu));
  };
  EXPECT_EQ(isotropic(0.48), "");
  EXPECT_NE(isotropic(0.49).find("ratio 0.49): fully integrated cells lock"),
            std::string::npos);
  EXPECT_NE(
    isotropic(0.499).find("1 + 1e+03 / n^2 times too stiff, 3.5 times for n = 20"),
    std::string::npos)
    << isotropic(0.499);
  const OrthotropicConstants fibres = {1e12, 1e9, 1e9, 0.3, 0.3, 0.4, 1e9, 1e9, 1e9};
  EXPECT_EQ(told(orthotropic_stiffness<2>(fibres), orthotropic_stiffness<3>(fibres)), "");
  EXPECT_EQ(stiffness_warnings<3>({{"a", isotropic_stiffness<3>(1e3, 0.3)},
                                   {"b", isotropic_stiffness<3>(1e3, 0.4999)}},
                                  simplices)
              .size(),
            2U);
}

TEST(Plausibility, WhatMakesASolveHard)
{
  const auto causes = [](const double nu, const double contrast, const double aspect) {
    return hard_to_solve<3>({{"a", isotropic_stiffness<3>(1e9, nu)},
                             {"b", isotropic_stiffness<3>(1e9 * contrast, 0.3)}},
                            aspect);
  };
  EXPECT_EQ(causes(0.3, 1e3, 1.), "");
  EXPECT_EQ(causes(0.3, 1., 1e4),
            "what makes it hard: cells are 1e+04 times as long as wide");
  EXPECT_NE(causes(-0.9999, 1., 1.).find("phase 'a' resists some strains"),
            std::string::npos);
  EXPECT_NE(causes(0.49999, 1., 1.).find("ratio 0.49999)"), std::string::npos);
  EXPECT_NE(causes(0.3, 1e6, 1.).find("times as stiff as phase 'a'"), std::string::npos);
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
