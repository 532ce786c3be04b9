#include "../io/io_testing.h"
#include "localization/localization_input.h"
#include "localization_testing.h"
#include "parameters/keys.h"

#include <fstream>
#include <gtest/gtest.h>

using namespace mesoslip_tests;

namespace
{
LocalizationParameters parse(const TemporaryFolder &folder, const std::string &more)
{
  const std::string text = "subsection Input\n set RVE file = rve.h5\n"
                           " set Homogeneous run = run\nend\n" +
                           more;
  Keys keys(RawParameters::parse(text, folder / "a.prm"));
  LocalizationParameters().bind(keys);
  keys.apply();
  LocalizationParameters parameters;
  parameters.bind(keys);
  parameters.check();
  return parameters;
}

std::string error(const TemporaryFolder &folder, const std::string &more)
{
  return user_error([&]() { parse(folder, more); });
}
} // namespace

TEST(LocalizationParameters, DefaultsAndFolders)
{
  TemporaryFolder folder;
  expect_contains(error(folder, ""), "Input/RVE file");
  std::ofstream(folder / "rve.h5") << "x";
  std::filesystem::create_directory(folder / "run");
  expect_contains(error(folder, ""), "run/dynamics.h5");
  std::ofstream(folder / "run/dynamics.h5") << "x";
  const auto p = parse(folder, "");
  EXPECT_EQ(p.homogeneous_run, folder / "run/dynamics.h5");
  EXPECT_TRUE(p.local_strain && !p.mean_strain && p.all_run_probes());
}

TEST(LocalizationParameters, KeysAndMistakes)
{
  TemporaryFolder folder;
  std::ofstream(folder / "rve.h5") << "x";
  std::filesystem::create_directory(folder / "run");
  std::ofstream(folder / "run/dynamics.h5") << "x";
  const auto p =
    parse(folder, "subsection Localization\n set Variant = both\n"
                  " set Fields = mean stress\n set Out-of-plane ratio = 0.2, 0\nend\n"
                  "subsection Probes\n set Of the run =\n set Further = A\n"
                  " subsection A\n  set Position = 1e-3, 2e-3\n end\nend\n");
  EXPECT_TRUE(p.local_strain && p.mean_strain);
  EXPECT_TRUE(!p.fields.von_mises && p.fields.mean && !p.fields.deviation);
  EXPECT_EQ(p.out_of_plane_ratio, (std::vector<double>{0.2, 0.}));
  EXPECT_TRUE(!p.all_run_probes() && p.run_probes.empty());
  ASSERT_EQ(p.further_probes.size(), 1u);
  EXPECT_EQ(p.further_probes[0].position[1], 2e-3);

  expect_contains(error(folder, "subsection Window\n set From = 2\n set To = 1\nend\n"),
                  "lies after To");
  expect_contains(error(folder, "subsection Localization\n set Fields =\nend\n"
                                "subsection Probes\n set Of the run =\nend\n"),
                  "nothing is asked for");
  expect_contains(
    error(folder, "subsection Localization\n set Fields = mean sress\nend\n"),
    "mean stress");
}
