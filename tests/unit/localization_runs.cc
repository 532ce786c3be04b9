// Two runs that are compared: under the same loads, over the same time.
#include "localization/localize.h"
#include "localization_testing.h"

#include <gtest/gtest.h>

using namespace mesoslip_tests;

TEST(Localize, RunsUnderOtherLoadsAreNotCompared)
{
  Case c;
  const auto grid         = make_grid(6, 4);
  const auto write_direct = [&](const std::optional<RunConditions> &conditions) {
    write_run(c.folder / "direct.h5", grid, {0.}, {c.state(grid)}, {}, "0123456789abcdef",
              c.rve.phase, conditions);
  };
  auto parameters       = c.request();
  parameters.direct_run = c.folder / "direct.h5";
  parameters.run_probes = {};

  RunConditions other = steady_conditions();
  other["pressure"]   = 6e6;
  other["beta2"]      = 0.6;
  write_direct(other);
  const auto sentence = user_error([&]() { LocalizationInput{parameters}; });
  expect_contains(sentence, "(pressure is 5e+06 Pa and 6e+06 Pa)");
  expect_contains(sentence, "Input/Allow different loads");
  parameters.allow_different_loads = true;
  LocalizationInput input(parameters);
  expect_contains(input.warnings.at(0), "not the error of localization");
  expect_contains(input.notes.at(0), "differ: beta2 is none and 0.6");
  ASSERT_EQ(input.differences.size(), 2u);
  EXPECT_TRUE(input.differences[0].of_load);
  EXPECT_FALSE(input.differences[1].of_load);

  // What is adapted on purpose, or part of the method, is told and no more.
  parameters.allow_different_loads = false;
  other["pressure"]                = 5e6;
  write_direct(other);
  EXPECT_TRUE(LocalizationInput(parameters).warnings.empty());

  write_direct(std::nullopt);
  parameters.from = 0.;
  expect_contains(LocalizationInput(parameters).warnings.at(0),
                  "direct.h5 does not tell its loads");
}

TEST(Localize, AHeterogeneousRunIsNoHomogeneousOne)
{
  Case c;
  const auto grid = make_grid(6, 4);
  write_run(c.folder / "homogeneous.h5", grid, {0.}, {c.state(grid)}, {},
            "0123456789abcdef", c.rve.phase);
  expect_contains(user_error([&]() { LocalizationInput{c.request()}; }),
                  "is one of a heterogeneous body");
}

// Snapshots 0 ... 4 and 0 ... 5 s: without a cut the last, 100 times as strained, would
// count for one of the runs only. Steps do not hit the same times exactly.
TEST(Localize, AveragesOfBothRunsAreOverTheSameTime)
{
  Case c;
  const auto grid = make_grid(6, 4);
  std::vector<std::vector<double>> ours(5, c.state(grid)), theirs = ours;
  theirs.push_back(c.state(grid, 100.));
  for (std::size_t k = 0; k < c.rve.L.size(); ++k)
    c.rve.L[k] = k % 9 % 4 == 0 ? 1. : 0.;
  c.rve.write(c.folder / "rve.h5");
  write_run(c.folder / "homogeneous.h5", grid, {0.02, 1.02, 2.02, 3.02, 4.02}, ours);
  write_run(c.folder / "direct.h5", grid, {0., 1., 2., 3., 4., 5.}, theirs, {},
            "0123456789abcdef", c.rve.phase);
  auto parameters       = c.request();
  parameters.direct_run = c.folder / "direct.h5";
  const auto result     = localize(parameters);
  EXPECT_EQ(LocalizationInput(parameters).snapshots.count, 5u);
  EXPECT_EQ(LocalizationInput(parameters).direct_snapshots.count, 5u);
  for (const FieldError &error : result.variants.at(0).errors)
    if (error.n_cells > 0 && error.quantity.find("mean") == 0)
      {
        EXPECT_NEAR(error.relative, 0., 1e-9) << error.quantity << error.region;
      }
}
