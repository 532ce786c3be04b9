// Keys of Grid, Phases and Microstructure that others leave without effect, and values
// that cannot be meant.
#include "microstructure_testing.h"

using namespace mesoslip;
using namespace mesoslip_tests;

TEST(MicrostructureParameters, SizesThatAreNone)
{
  for (const char *size : {"1e-300, 1e-300", "1e300, 1e300", "0, 1"})
    expect_contains(error_of({std::string("Grid/Size=") + size}),
                    "must be 2 comma separated numbers in [1e-15, 1e+09]");
  expect_contains(error_of({"Grid/Cells=1000, 1000", "Grid/Spacing=1e8"}),
                  "Grid/Size: 1e+11 m is not the size of a box");
  expect_contains(error_of({"Phases/matrix/Density=1e-300"}), "Density");
  expect_contains(error_of({"Phases/matrix/Young modulus=1e300"}), "Young modulus");
}

// Without a word before: the phase named fibre had the paper's 240 GPa.
TEST(MicrostructureParameters, NoModulusFromAName)
{
  const std::string advice =
    "/Young modulus' is 0; give the modulus in Pa, or set Type = orthotropic (with Young "
    "moduli, Poisson ratios and Shear moduli) or Type = stiffness (with "
    "Stiffness)";
  expect_contains(error_of({}, ""), "'Phases/matrix" + advice);
  expect_contains(error_of({"Phases/matrix/Young modulus=30e9"}, ""),
                  "'Phases/fibre" + advice);
  const auto matrix = checked({"Phases/Names=matrix", "Microstructure/Type=homogeneous",
                               "Phases/matrix/Young modulus=2e9"},
                              "");
  EXPECT_EQ(matrix.phases[0].density, 0.);
}

TEST(MicrostructureParameters, KeysWithoutEffectAreRefused)
{
  struct Row
  {
    Settings settings;
    std::string said;
  };
  const std::string fibre = "Phases/fibre/", image = "Microstructure/Type=image",
                    values    = "Microstructure/Image values=0, 1";
  const std::vector<Row> rows = {
    {{fibre + "Young moduli=1e9, 2e9, 3e9"},
     "--set 'Phases/fibre/Young moduli=1e9, 2e9, 3e9': Phases/fibre/Young moduli has no "
     "effect, as Phases/fibre/Type is 'isotropic'; remove it, or set Phases/fibre/Type = "
     "orthotropic"},
    {{fibre + "Shear moduli=1e9, 2e9, 3e9"}, "Type = orthotropic"},
    {{fibre + "Poisson ratios=0.1, 0.1, 0.1"}, "Type = orthotropic"},
    {{fibre + "Stiffness=4e9, 1e9, 3e9, 2e9"}, "Type = stiffness"},
    {{fibre + "Angle=0.5"}, "Type = orthotropic or stiffness"},
    {{fibre + "Type=stiffness"},
     "run.prm:8: Phases/fibre/Young modulus has no effect, as Phases/fibre/Type is "
     "'stiffness'"},
    {{"Microstructure/File=a.png"}, "Type = rectangles or image"},
    {{values}, "Microstructure/Type is 'random fibres'"},
    {{"Microstructure/Oblong pixels=true"}, "Type = image"},
    {{"Microstructure/Type=rectangles", values}, "Type = image"},
    {{image, fibres("Seed=3"), fibres("Area fraction=0.2")},
     "Microstructure/Random fibres/Seed has no effect, as Microstructure/Type is "
     "'image', "
     "nor has Microstructure/Random fibres/Area fraction; remove them, or set "
     "Microstructure/Type = random fibres"},
    {{fibres("Fraction rule=nominal"), fibres("Trim last fibre=false")},
     "Fraction rule = actual"}};
  for (const Row &row : rows)
    expect_contains(error_of(row.settings), row.said);
  // Set, but to the default: so is every key in the parameters.prm of a run.
  EXPECT_NO_THROW(
    checked({fibre + "Young moduli=", fibre + "Angle=0.0", fibres("Trim last fibre=yes"),
             fibres("Fraction rule=nominal")}));
}

TEST(MicrostructureParameters, AnglesInDegrees)
{
  const auto warnings = [](const std::string &angle) {
    Settings settings = {"Phases/fibre/Type=stiffness", "Phases/fibre/Angle=" + angle,
                         "Phases/fibre/Stiffness=4e9, 1e9, 3e9, 2e9"};
    return make_microstructure(checked(settings, "subsection Phases\nsubsection matrix\n"
                                                 "set Young modulus = 1e9\nend\nend\n"))
      .warnings;
  };
  EXPECT_TRUE(warnings("6.28").empty());
  ASSERT_EQ(warnings("-45").size(), 1u);
  expect_contains(warnings("-45")[0], "'Phases/fibre/Angle' is -45 rad, more than a full "
                                      "turn; -45 degrees would be -0.785398 rad");
}
