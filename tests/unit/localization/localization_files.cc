#include "../io/io_testing.h"
#include "localization/localization_program.h"
#include "localization_testing.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace mesoslip_tests;

TEST(Localize, UniformMacroscopicStrainGivesTheSolutionOfTheRve)
{
  Case c;
  auto parameters        = c.request();
  parameters.mean_strain = true;
  const auto result      = localize(parameters);
  ASSERT_EQ(result.variants.size(), 2u);
  for (const VariantResult &variant : result.variants)
    for (std::size_t cell = 0; cell < c.rve.grid.n_cells(); ++cell)
      {
        const VoigtVector<2> stress = c.rve.matrix(cell) * c.strain;
        for (unsigned int k = 0; k < 3; ++k)
          {
            EXPECT_NEAR(variant.fields.mean_stress[3 * cell + k], stress[k],
                        1e-10 * stress.norm());
            EXPECT_EQ(variant.fields.deviation_stress[3 * cell + k], 0.);
          }
      }
  // The probe's own strain (eq. 24) at its two times, the body's at the only snapshot.
  const VoigtVector<2> stress = c.rve.matrix(1) * c.strain;
  const ProbeResult &probe    = result.variants[0].probes.at(0);
  ASSERT_EQ(probe.time.size(), 2u);
  EXPECT_NEAR(probe.statistics[1].mean, 1.5 * stress[1], 1e-10 * stress.norm());
  EXPECT_NEAR(probe.statistics[1].deviation, 0.5 * std::fabs(stress[1]),
              1e-10 * stress.norm());
  const ProbeResult &by_mean = result.variants[1].probes.at(0);
  ASSERT_EQ(by_mean.time.size(), 1u);
  EXPECT_NEAR(by_mean.stress[0], stress[0], 1e-10 * stress.norm());
}

TEST(Localize, IdentityTensorsGiveThePhasesStress)
{
  Case c;
  c.write_identity();
  auto parameters           = c.request();
  parameters.further_probes = {{"centre", {{3e-3, 2e-3}}}};
  const auto result         = localize(parameters);
  for (std::size_t cell = 0; cell < c.rve.grid.n_cells(); ++cell)
    {
      const VoigtVector<2> stress = c.rve.stiffness[c.rve.phase[cell]] * c.strain;
      for (unsigned int k = 0; k < 3; ++k)
        EXPECT_NEAR(result.variants[0].fields.mean_stress[3 * cell + k], stress[k],
                    1e-10 * stress.norm());
    }
  // Between four cells: the upper right one, (3, 2).
  const ProbeResult &further = result.variants[0].probes.at(1);
  EXPECT_EQ(OpenedInput(parameters).input.probes.at(1).cell,
            (std::vector<unsigned int>{3, 2}));
  const VoigtVector<2> stress = c.rve.stiffness[c.rve.phase[15]] * c.strain;
  EXPECT_NEAR(further.stress[1], stress[1], 1e-10 * stress.norm());
}

TEST(Localize, DirectRunOnARefinedGridIsCompared)
{
  Case c;
  // More snapshots than fit into one batch; the direct run strains 10 % less.
  const auto coarse = make_grid(6, 4), fine = make_grid(12, 12);
  std::vector<double> times;
  std::vector<std::vector<double>> ours, theirs;
  double mean = 0., square = 0.;
  for (unsigned int k = 0; k < 40; ++k)
    {
      const double factor = 1. + 0.2 * std::sin(k);
      times.push_back(k * 1e-6);
      ours.push_back(c.state(coarse, factor));
      theirs.push_back(c.state(fine, 0.9 * factor));
      mean += factor / 40.;
      square += factor * factor / 40.;
    }
  c.write_identity();
  write_run(c.folder / "homogeneous.h5", coarse, times, ours, {c.probe("A", 1.)});
  write_run(c.folder / "direct.h5", fine, times, theirs, {c.probe("other", 0.5)},
            "0123456789abcdef", c.refined_phase(fine));

  auto parameters           = c.request();
  parameters.direct_run     = c.folder / "direct.h5";
  parameters.further_probes = {{"B", {{0.5e-3, 0.5e-3}}}};
  const auto result         = localize(parameters);
  const VariantResult &v    = result.variants.at(0);
  EXPECT_EQ(OpenedInput(parameters).input.plan.direct_snapshots.count, 40u);
  ASSERT_FALSE(v.errors.empty());
  for (const FieldError &error : v.errors)
    if (error.n_cells > 0)
      {
        EXPECT_NEAR(error.relative, 1. / 9., 1e-7) << error.quantity << error.region;
      }
  const VoigtVector<2> stress = c.rve.stiffness[0] * c.strain;
  EXPECT_NEAR(v.fields.deviation_stress[0],
              std::sqrt(square - mean * mean) * std::fabs(stress[0]),
              1e-9 * stress.norm());
  EXPECT_NEAR(v.difference.mean_stress[1], 0.1 * mean * stress[1], 1e-9 * stress.norm());
  // Same place under another name, with its own L-times stress.
  EXPECT_FALSE(v.probes.at(0).direct_stress.empty());
  // Followed through the snapshots of both.
  EXPECT_NEAR(v.probes.at(1).statistics[0].error_mean, 1. / 9., 1e-9);
  EXPECT_NEAR(v.probes.at(1).statistics[0].rms_difference, 1. / 9., 1e-9);
}

TEST(Localize, OnlyTheWindowCounts)
{
  Case c;
  const auto grid = make_grid(6, 4);
  write_run(
    c.folder / "homogeneous.h5", grid, {0., 1., 2., 3.},
    {c.state(grid, 100.), c.state(grid, 1.), c.state(grid, 3.), c.state(grid, 9.)});
  auto parameters        = c.request();
  parameters.from        = 1.;
  parameters.to          = 2.;
  parameters.fields      = {false, true, false};
  auto result            = localize(parameters);
  const auto n_snapshots = [&]() {
    return OpenedInput(parameters).input.plan.snapshots.count;
  };
  EXPECT_EQ(n_snapshots(), 2u);
  EXPECT_TRUE(result.variants[0].fields.mean_von_mises.empty());
  EXPECT_TRUE(result.variants[0].fields.deviation_stress.empty());
  const VoigtVector<2> stress = c.rve.matrix(0) * c.strain;
  EXPECT_NEAR(result.variants[0].fields.mean_stress[0], 2. * stress[0],
              1e-10 * stress.norm());
  // Nothing given: from when the run was steady, as the file tells; whatever lies beside.
  std::ofstream(c.folder / "summary.json") << "{\"steady_from\": 0.5}";
  parameters.from = parameters.to = std::nan("");
  const auto steady_from          = [&](const std::optional<RunConditions> &conditions) {
    write_run(c.folder / "homogeneous.h5", grid, {0., 1., 2., 3.},
                       {c.state(grid), c.state(grid), c.state(grid), c.state(grid)}, {},
                       "0123456789abcdef", {}, conditions);
  };
  RunConditions conditions  = steady_conditions();
  conditions["steady_from"] = 2.5;
  steady_from(conditions);
  EXPECT_EQ(n_snapshots(), 1u);
  steady_from(std::nullopt); // an older file: never the whole run in silence
  expect_error("Window/From is auto, but " + c.folder / "homogeneous.h5" +
                 " does not tell from when on the run is steady",
               [&] { n_snapshots(); });
  parameters.from = 0.;
  EXPECT_EQ(n_snapshots(), 4u);
  parameters.from = 5.;
  const auto text = user_error([&]() { n_snapshots(); });
  expect_contains(text, "no snapshot lies after 5");
  expect_contains(text, "Window/From");
}

TEST(Localize, WrongFilesAreNamed)
{
  Case c;
  auto parameters  = c.request();
  const auto error = [&]() { return user_error([&]() { OpenedInput{parameters}; }); };
  parameters.concentration = "PBC";
  expect_contains(error(), "/concentration/PBC");
  parameters.concentration = "KUBC";

  parameters.rve_file = c.folder / "homogeneous.h5";
  expect_contains(error(), "mesoslip-rve");
  parameters.rve_file = c.folder / "rve.h5";

  parameters.run_probes = {"Z"};
  expect_contains(error(), "Probes/Of the run names 'Z'");
  parameters.run_probes     = {};
  parameters.further_probes = {{"far", {{1., 0.}}}};
  expect_contains(error(), "outside the body");
  parameters.further_probes = {};

  UniformGrid<2> wide = make_grid(6, 4);
  wide.spacing[0] *= 1.001;
  write_run(c.folder / "direct.h5", wide, {0.}, {c.state(wide)});
  parameters.direct_run = c.folder / "direct.h5";
  expect_contains(error(), "covers");
  write_run(c.folder / "direct.h5", make_grid(3, 4), {0.}, {c.state(make_grid(3, 4))});
  expect_contains(error(), "no whole multiple of the 6 x 4");
  auto phase = c.rve.phase;
  std::swap(phase[0], phase[1]);
  write_run(c.folder / "direct.h5", make_grid(6, 4), {0.}, {c.state(make_grid(6, 4))}, {},
            "0123456789abcdef", phase);
  expect_contains(error(), "another material");
  expect_contains(error(), "in the cell at (5e-04, 5e-04) m");
  // The body of a homogeneous run is no direct one.
  write_run(c.folder / "direct.h5", make_grid(6, 4), {0.}, {c.state(make_grid(6, 4))});
  expect_contains(error(), "in the cell at (0.0015, 5e-04) m");

  write_run(c.folder / "homogeneous.h5", make_grid(6, 4), {}, {});
  parameters.direct_run = "";
  expect_contains(error(), "Snapshots/Interval");
}

TEST(Localize, OtherDigestIsAWarning)
{
  Case c;
  write_run(c.folder / "homogeneous.h5", make_grid(6, 4), {0.},
            {c.state(make_grid(6, 4))}, {}, "another");
  std::string warnings;
  localize(c.request(), &warnings);
  expect_contains(warnings, "another");
  expect_contains(warnings, "0123456789abcdef");
}

TEST(LocalizationOutput, FileAndSummary)
{
  Case c;
  write_run(c.folder / "direct.h5", make_grid(6, 4), {0.}, {c.state(make_grid(6, 4), 2.)},
            {c.probe("A", 2.)}, "0123456789abcdef", c.rve.phase);
  auto parameters        = c.request();
  parameters.direct_run  = c.folder / "direct.h5";
  parameters.mean_strain = true;
  OpenedInput opened(parameters);
  const auto result = opened.localize();
  write_localization(origin_of(opened.input), result, "", c.folder.path);
  const auto file = LocalizationFile::open(c.folder / "localization.h5");
  EXPECT_EQ(file.shape("/mean_von_mises"), (Shape{4, 6}));
  for (const std::string group : {"", "/direct", "/difference", "/mean_strain_variant"})
    EXPECT_EQ(file.fields(group).mean_stress.size(), 72u) << group;
  EXPECT_EQ(file.fields("").deviation_stress, result.variants[0].fields.deviation_stress);
  const LocalizedProbe found    = file.probe("A", ""),
                       &written = result.variants[0].probes[0];
  EXPECT_EQ(found.direct_stress, written.direct_stress);
  EXPECT_EQ(found.stress, written.stress);
  EXPECT_EQ(found.cell, written.cell);
  EXPECT_EQ(found.position, written.position);
  EXPECT_EQ(found.phase_name, "fibre");
  EXPECT_EQ(found.phase, 1u);
  for (const char *name : {"localization.xdmf", "probes.csv", "field_errors.csv"})
    EXPECT_TRUE(std::filesystem::exists(c.folder / name)) << name;

  nlohmann::json summary;
  summarize_localization(origin_of(opened.input), result, summary);
  const auto &probe = summary["probes"][0];
  EXPECT_EQ(probe["phase"], "fibre");
  // Half of the direct series at every time.
  EXPECT_NEAR(probe["sigma_xx"]["error_mean"].get<double>(), -0.5, 1e-12);
  EXPECT_NEAR(probe["sigma_yy"]["error_std"].get<double>(), -0.5, 1e-12);
  EXPECT_NEAR(probe["sigma_xy"]["rms_difference"].get<double>(), 0.5, 1e-12);
  EXPECT_TRUE(summary["field_errors"]["mean_von_mises"]["surface"].is_null() ||
              summary["field_errors"]["mean_von_mises"]["all"].is_number());
  EXPECT_TRUE(summary["mean_strain_variant"]["field_errors"].is_object());
}

TEST(Localize, ProbesThatShareNoTimeAreNotCompared)
{
  Case c;
  TestProbe late = c.probe("A", 1.);
  late.time      = {5., 6.};
  write_run(c.folder / "direct.h5", make_grid(6, 4), {0.}, {c.state(make_grid(6, 4))},
            {late}, "0123456789abcdef", c.rve.phase);
  auto parameters       = c.request();
  parameters.direct_run = c.folder / "direct.h5";
  std::string warnings;
  const auto result = localize(parameters, &warnings);
  expect_contains(warnings, "no time in common");
  const ProbeResult &probe = result.variants[0].probes.at(0);
  EXPECT_EQ(probe.time.size(), 2u);
  EXPECT_TRUE(probe.direct_stress.empty());
  EXPECT_TRUE(std::isnan(probe.statistics[0].direct_mean));
}

// Snapshots 0 ... 4 and 0 ... 5 s: without a cut the last, 100 times as strained, would
// count for one of the runs only. Steps do not hit the same times exactly.
TEST(Localize, AveragesOfBothRunsAreOverTheSameTime)
{
  Case c;
  const auto grid = make_grid(6, 4);
  std::vector<std::vector<double>> ours(5, c.state(grid)), theirs = ours;
  theirs.push_back(c.state(grid, 100.));
  c.write_identity();
  write_run(c.folder / "homogeneous.h5", grid, {0.02, 1.02, 2.02, 3.02, 4.02}, ours);
  write_run(c.folder / "direct.h5", grid, {0., 1., 2., 3., 4., 5.}, theirs, {},
            "0123456789abcdef", c.rve.phase);
  auto parameters       = c.request();
  parameters.direct_run = c.folder / "direct.h5";
  const auto result     = localize(parameters);
  EXPECT_EQ(OpenedInput(parameters).input.plan.snapshots.count, 5u);
  EXPECT_EQ(OpenedInput(parameters).input.plan.direct_snapshots.count, 5u);
  for (const FieldError &error : result.variants.at(0).errors)
    if (error.n_cells > 0 && error.quantity.find("mean") == 0)
      {
        EXPECT_NEAR(error.relative, 0., 1e-9) << error.quantity << error.region;
      }
}
