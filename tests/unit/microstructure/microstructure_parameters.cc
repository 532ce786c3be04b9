// Sections Grid, Phases and Microstructure of a .prm: defaults, errors, what they make.
#include "microstructure_testing.h"

#include "base/files.h"
#include "material/stiffness.h"

#include <cmath>
#include <sstream>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
const std::string csv_start = "x_left_mm,y_bottom_mm,width_mm,height_mm,phase\n";
} // namespace

TEST(MicrostructureParameters, DefaultsAreThePaper)
{
  const auto result = make_microstructure(checked({}));
  EXPECT_EQ(result.map.grid.cells, (std::array<unsigned int, 2>{{560, 160}}));
  EXPECT_NEAR(result.map.grid.spacing[0], 1e-4, 1e-18);
  EXPECT_NEAR(result.map.grid.spacing[1], 1e-4, 1e-18);
  ASSERT_EQ(result.phases.size(), 2u);
  EXPECT_EQ(result.phases[0].name, "matrix");
  EXPECT_EQ(result.phases[0].stiffness, isotropic_stiffness<2>(30e9, 0.2));
  EXPECT_EQ(result.phases[1].stiffness, isotropic_stiffness<2>(240e9, 0.2));
  EXPECT_EQ(result.phases[1].density, 1770.);
  EXPECT_EQ(result.phases[1].friction_coefficient, 0.25);
  EXPECT_DOUBLE_EQ(area_fractions(result.map, 2)[1], 0.1);
  EXPECT_EQ(morphology_digest(result.map), 11980823772313234077u);
  EXPECT_GT(result.rectangles.size(), 300u);
  EXPECT_TRUE(result.warnings.empty());
}

TEST(MicrostructureParameters, GridBySpacing)
{
  const auto square = checked({"Grid/Cells=100, 50", "Grid/Spacing=2e-4",
                               "Microstructure/Type=homogeneous"})
                        .grid;
  EXPECT_DOUBLE_EQ(square.extent(0), 0.02);
  EXPECT_DOUBLE_EQ(square.extent(1), 0.01);
  const Settings oblong = {"Grid/Cells=100, 50", "Grid/Spacing=1e-4, 3e-4",
                           "Microstructure/Type=homogeneous"};
  EXPECT_DOUBLE_EQ(checked(oblong).grid.spacing[1], 3e-4);
  expect_contains(error_of({"Grid/Cells=1000000, 1000000"}), "Grid/Cells: ");
  expect_contains(error_of({"Grid/Cells=1000, 1000", "Grid/Spacing=1e8"}),
                  "Grid/Size: 1e+11 m is not the size of a box");
  // A size beside it has to be the same.
  EXPECT_NO_THROW(
    checked({"Grid/Cells=100, 50", "Grid/Spacing=1e-4", "Grid/Size=0.01, 0.005"}));
  expect_contains(
    error_of({"Grid/Cells=80, 40", "Grid/Spacing=1e-6", "Grid/Size=0.008, 0.004"}),
    "Grid/Size has no effect, as Grid/Cells times Grid/Spacing make a box of 80 x 40 "
    "um; remove it, or leave Grid/Spacing empty");
}

TEST(MicrostructureParameters, PhasesOfAllTypes)
{
  const std::string text = R"(
subsection Phases
  set Names = resin, carbon, glue
  subsection resin
    set Young modulus = 3e9
    set Poisson ratio = 0.35
  end
  subsection carbon
    set Type           = orthotropic
    set Young moduli   = 140e9, 10e9, 8e9
    set Poisson ratios = 0.3, 0.28, 0.4
    set Shear moduli   = 5e9, 4e9, 3e9
    set Angle          = 0.5
  end
  subsection glue
    set Type                   = stiffness
    set Stiffness              = 4e9, 1e9, 3e9, 2e9
    set Density                = 900
  end
end
)";
  const auto phases      = checked({fibres("Phase=glue")}, text).phases;
  const auto made        = make_phases<2>(phases);
  EXPECT_EQ(made[0].stiffness, isotropic_stiffness<2>(3e9, 0.35));
  const auto carbon =
    orthotropic_stiffness<2>({140e9, 10e9, 8e9, 0.3, 0.28, 0.4, 5e9, 4e9, 3e9});
  EXPECT_EQ(made[1].stiffness, rotate_stiffness<2>(carbon, 0.5));
  EXPECT_EQ(made[2].stiffness(1, 1), 3e9);
  EXPECT_EQ(made[2].density, 900.);
  expect_error("there is no phase 'gluon'; Phases/Names has resin, carbon, glue",
               [&] { checked({fibres("Phase=gluon")}, text); });
  const auto swapped = checked({fibres("Phase=glue")}, text);
  EXPECT_DOUBLE_EQ(area_fractions(make_microstructure(swapped).map, 3)[2], 0.1);
}

TEST(MicrostructureParameters, PhaseErrors)
{
  expect_contains(error_of({"Phases/Names=matrix, fibre, carbon"}),
                  "'Phases/carbon/Young modulus'");
  expect_contains(error_of({"Phases/Names=a, a"}, ""), "two phases named 'a'");
  const std::string matrix = "Phases/matrix/Young modulus=30e9";
  expect_contains(error_of({"Phases/Names=matrix", matrix}, ""), "only one phase");
  expect_contains(error_of({matrix, "Phases/fibre/Type=orthotropic"}, ""),
                  "'Phases/fibre/Young moduli': there are 0 values");
  expect_contains(error_of({matrix, "Phases/fibre/Type=stiffness"}, ""),
                  "'Phases/fibre': there are 0 stiffness coefficients");
  expect_contains(error_of({matrix, "Phases/fibre/Type=stiffness",
                            "Phases/fibre/Stiffness=1e9, 2e9, 3e9, 1e9"},
                           ""),
                  "not positive definite");
  expect_contains(
    error_of({"Phases/fibre/Stiffness coefficients=1e9"}),
    "the key Phases/fibre/Stiffness coefficients is called 'Stiffness' now");
  expect_contains(error_of({"Phases/fibre/Poisson ratio=0.5"}), "Poisson ratio");
  expect_contains(error_of({"Phases/fibre/Density=-1"}), "Density");
  expect_contains(error_of({"Phases/matrix/Density=1e-300"}), "Density");
  expect_contains(error_of({"Phases/matrix/Young modulus=1e300"}), "Young modulus");
  expect_contains(error_of({"Phases/matrix/Young modulus=30e9"}, ""),
                  "'Phases/fibre/Young modulus' is 0; give the modulus in Pa");
  expect_contains(error_of({fibres("Phase=matrix")}), "is the background");
}

TEST(MicrostructureParameters, FibreErrors)
{
  expect_contains(error_of({fibres("Fibre width=5e-5")}), "is less than a cell");
  expect_contains(error_of({fibres("Minimum height=5e-5")}), "is less than a cell");
  expect_contains(error_of({fibres("Minimum height=4e-3")}),
                  "is more than the maximum height");
  expect_contains(error_of({fibres("Maximum height=0.0161")}), "is more than the box");
  EXPECT_NO_THROW(
    checked({fibres("Maximum height=0.0161"), fibres("Cut by border=true")}));
  expect_contains(error_of({fibres("Fibre width=0.06")}), "is more than the box");
  expect_contains(error_of({fibres("Area fraction=1")}), "Area fraction");
  expect_contains(error_of({fibres("Allow overlap=true"), fibres("Minimum gap=1e-4")}),
                  "contradicts Allow overlap");
  expect_contains(error_of({fibres("Placement spacing=1.5e-4")}), "does not divide");
}

// Each with its own words; the command line's are in system/programs/bad_input.
TEST(MicrostructureParameters, KeysWithoutEffectAreRefused)
{
  const std::string fibre = "Phases/fibre/", image = "Microstructure/Type=image",
                    values = "Microstructure/Image values=0, 1";
  const std::vector<std::pair<Settings, std::string>> rows = {
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
     "'image', nor has Microstructure/Random fibres/Area fraction; remove them, or set "
     "Microstructure/Type = random fibres"},
    {{fibres("Fraction rule=nominal"), fibres("Trim last fibre=false")},
     "Fraction rule = actual"}};
  for (const auto &[settings, said] : rows)
    expect_contains(error_of(settings), said);
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

TEST(MicrostructureParameters, RefiningTheGridKeepsTheMorphology)
{
  const auto coarse = make_microstructure(checked({}));
  const auto fine   = make_microstructure(
      checked({"Grid/Cells=1120, 320", fibres("Placement spacing=1e-4")}));
  EXPECT_EQ(fine.map.id, refined_map(coarse.map, fine.map.grid).id);
  // What would be written draws the same.
  EXPECT_EQ(fine.map.id, draw_rectangles(fine.map.grid, fine.rectangles).id);
}

TEST(MicrostructureParameters, Warnings)
{
  const auto full =
    make_microstructure(checked({fibres("Area fraction=0.9"), fibres("Minimum gap=1e-4"),
                                 fibres("Fibre width=1.3e-4")}));
  ASSERT_EQ(full.warnings.size(), 2u);
  expect_contains(full.warnings[0], "0.00013 m is no multiple of the cell");
  expect_contains(full.warnings[0], "rounded to 1e-04 m");
  expect_contains(full.warnings[1], "90 % asked for, ");
  expect_contains(full.warnings[1], "no further one fits in");
  // A column of fibre and a column of gap: at most one half.
  EXPECT_LE(area_fractions(full.map, 2)[1], 0.5);
}

TEST(MicrostructureParameters, Homogeneous)
{
  const auto result =
    make_microstructure(checked({"Microstructure/Type=homogeneous", "Phases/Names=matrix",
                                 "Phases/matrix/Young modulus=30e9"},
                                ""));
  EXPECT_EQ(area_fractions(result.map, 1), std::vector<double>{1.});
}

TEST(MicrostructureParameters, RectanglesFromAFile)
{
  TemporaryFolder folder;
  const Settings settings = {"Microstructure/Type=rectangles",
                             "Microstructure/File=" + (folder / "r.csv")};
  expect_contains(error_of(settings), "Microstructure/File: ");
  expect_contains(error_of({settings[0]}), "Microstructure/File: ");
  write_file(folder / "r.csv", csv_start + "1,2,0.1,3,1\n");
  const auto result = make_microstructure(checked(settings));
  EXPECT_EQ(std::count(result.map.id.begin(), result.map.id.end(), 1), 30);
  EXPECT_EQ(result.rectangles.size(), 1u);
  write_file(folder / "r.csv", csv_start + "1,2,0.1,3,2\n");
  expect_contains(error_of(settings), "rectangle 1 has the phase 2");
  write_file(folder / "r.csv", csv_start + "1,2,0.1,3,1\n60,2,0.1,3,1\n");
  expect_contains(error_of(settings), "r.csv:3: ");
}

TEST(MicrostructureParameters, ImageFromAFile)
{
  TemporaryFolder folder;
  const Settings settings = {"Microstructure/Type=image", "Grid/Cells=4, 2",
                             "Grid/Size=4, 2",
                             "Microstructure/File=" + (folder / "a.txt")};
  write_file(folder / "a.txt", "0 255\n0 0\n");
  const auto oblong = [](Settings more) {
    more.push_back("Microstructure/Oblong pixels=true");
    return more;
  };
  expect_contains(error_of(settings), "2 x 2 pixels would be 2 m wide and 1 m high");
  const auto result = make_microstructure(checked(oblong(settings)));
  EXPECT_EQ(result.map.id, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 1, 1}));
  ASSERT_EQ(result.description.size(), 3u);
  EXPECT_EQ(result.description[0],
            "Morphology: 2 x 2 pixels of a.txt, each 2 x 1 m, 2 x 1 cells per pixel");
  EXPECT_EQ(result.description[1],
            "Phase 0, matrix: value 0, 75 % of the pixels, 6 cells, "
            "75 %; E = 30 GPa, nu = 0.2, 1770 kg/m^3");
  Settings values = oblong(settings);
  values.push_back("Microstructure/Image values=255, 0");
  EXPECT_EQ(make_microstructure(checked(values)).map.id[0], 1);
  values.back() = "Microstructure/Image values=255";
  expect_contains(error_of(values), "1 different values for 2 phases");
  values.back() = "Microstructure/Image values=255, 1";
  expect_contains(error_of(values), "the values 0, 255, and 0 belongs");
  write_file(folder / "a.txt", "0 255 1\n0 0 1\n");
  expect_contains(error_of(settings), "3 x 2 pixels");
}

TEST(MicrostructureParameters, CoarseningIsToldAndWarnedOf)
{
  TemporaryFolder folder;
  const auto made = [&](const std::string &row, const std::string &cells) {
    write_file(folder / "a.txt", row + row);
    return make_microstructure(
      checked({"Microstructure/Type=image", "Grid/Cells=" + cells,
               "Grid/Size=0.006, 0.002", "Microstructure/File=" + (folder / "a.txt")}));
  };
  EXPECT_TRUE(made("0 0 0 0 1 1\n", "3, 1").warnings.empty());
  const auto coarse = made("0 1 1 1 1 0\n", "3, 1");
  EXPECT_EQ(coarse.description[0], "Morphology: 6 x 2 pixels of a.txt, each 1 x 1 mm, "
                                   "2 x 2 per cell, of which the majority decides");
  EXPECT_TRUE(coarse.warnings.empty()); // 0 and 1, as many pixels each: one cell each
  const auto gone = made("0 0 0 1 0 0\n", "1, 1");
  ASSERT_EQ(gone.warnings.size(), 2u); // that, and a phase that fills no cell
  expect_contains(gone.warnings[0],
                  "phase 'matrix' is 83.333 % of the image and 100 % of the cells, phase "
                  "'fibre' is 16.667 % of the image and 0 % of the cells, as each cell");
}
