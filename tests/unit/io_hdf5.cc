// Exchange files: round trips, and what is said about foreign or damaged ones.
#include "io_testing.h"

#include "base/files.h"
#include "io/hdf5/internal.h"

#include <cmath>
#include <limits>
#include <numeric>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
std::vector<double> counted(const std::size_t n)
{
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = std::sqrt(i + 0.1);
  return values;
}
} // namespace

TEST(Hdf5, WholeDatasetsComeBack)
{
  const TemporaryFolder folder;
  const std::string path               = folder / "a.h5";
  const std::vector<std::string> names = {"matrix", "", "fibre \xc3\xa9"};
  const std::vector<std::uint8_t> ids  = {0, 1, 255, 3, 4, 5};
  const std::vector<double> numbers    = counted(24);
  {
    Hdf5File file = Hdf5File::create(path);
    file.write_header("mesoslip-rve", 1, 2, "abc");
    file.write("/phase/id", {2, 3}, ids);
    file.write("/deep/er/numbers", {2, 3, 4}, counted(24));
    file.write("/empty", {0, 3}, std::vector<double>());
    file.write("/scalar", {}, std::vector<int>{-7});
    file.write("/scalar", {}, std::vector<int>{-8});
    file.write("/phase/name", {3}, names);
    file.write_attribute("/grid", "cells", std::vector<unsigned int>{3, 2});
    file.write_attribute("/grid", "spacing", std::vector<double>{1. / 3., 0.5});
    file.write_attribute("/grid", "note", std::string("first"));
    file.write_attribute("/grid", "note", std::string("second"));
    EXPECT_FALSE(std::filesystem::exists(path)) << "only complete files have the name";
    EXPECT_ANY_THROW(file.write("/x", {2}, std::vector<double>{1.}));
  }
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.read<std::uint8_t>("/phase/id", {any_extent, 3}), ids);
  EXPECT_EQ(file.read<int>("/phase/id")[2], 255);
  EXPECT_EQ(file.read<double>("/deep/er/numbers", {2, 3, 4}), numbers);
  EXPECT_EQ(file.read<float>("/deep/er/numbers")[3], static_cast<float>(numbers[3]));
  EXPECT_TRUE(file.read<double>("/empty", {0, 3}).empty());
  EXPECT_EQ(file.read<int>("/scalar"), std::vector<int>{-8});
  EXPECT_EQ(file.read<std::string>("/phase/name"), names);
  EXPECT_EQ(file.read_attribute<std::vector<double>>("/grid", "spacing")[0], 1. / 3.);
  EXPECT_EQ(file.read_attribute<std::string>("/grid", "note"), "second");
  EXPECT_EQ(file.list("/phase"), (std::vector<std::string>{"id", "name"}));
  EXPECT_TRUE(file.exists("/deep/er") && !file.exists("/deep/est/x"));
  EXPECT_EQ(file.check_header("mesoslip-rve", 1, 2), "abc");
}

TEST(Hdf5, BlocksAreReadWithoutTheRest)
{
  const TemporaryFolder folder;
  {
    Hdf5File file = Hdf5File::create(folder / "b.h5");
    file.write("/field", {5, 4, 3, 2}, counted(120));
  }
  const Hdf5File file           = Hdf5File::open(folder / "b.h5");
  const std::vector<double> all = counted(120);
  EXPECT_EQ(file.read_block<double>("/field", {2, 0, 0, 0}, {1, 4, 3, 2}),
            std::vector<double>(all.begin() + 48, all.begin() + 72));
  const auto node = file.read_block<double>("/field", {0, 3, 1, 0}, {5, 1, 1, 2});
  ASSERT_EQ(node.size(), 10u);
  for (std::size_t k = 0; k < 5; ++k)
    EXPECT_EQ(node[2 * k + 1], all[24 * k + 3 * 6 + 1 * 2 + 1]);
  expect_contains(user_error([&]() {
                    file.read_block<double>("/field", {5, 0, 0, 0}, {1, 4, 3, 2});
                  }),
                  "has the shape [5][4][3][2], which does not hold [1][4][3][2]");
}

TEST(Hdf5, RowsSurviveAProcessThatDies)
{
  const TemporaryFolder folder;
  const std::string path = folder / "c.h5";
  const auto write       = [&](Hdf5File &file, const std::size_t first) {
    for (std::size_t k = first; k < first + 3; ++k)
      file.write_row("/snapshots/u", k, std::vector<double>(12, 1. * k));
    file.sync();
  };
  const auto begin_and_die = [&]() {
    Hdf5File file = Hdf5File::create(path);
    file.reserve_rows("/snapshots/u", {5, 4, 3});
    file.flush();
    write(file, 0);
    std::_Exit(0);
  };
  EXPECT_EXIT(begin_and_die(), ::testing::ExitedWithCode(0), "");
  EXPECT_FALSE(std::filesystem::exists(path)) << "only complete files have the name";
  const auto go_on = [&](const std::size_t n) {
    Hdf5File file = Hdf5File::resume(path);
    EXPECT_EQ(file.read<double>("/snapshots/u")[12], 1.);
    file.reserve_rows("/snapshots/u", {n, 4, 3});
    file.flush();
    write(file, 2);
    file.write("/more", {1}, std::vector<double>{1.});
    file.close();
  };
  go_on(5);
  go_on(8); // of a completed file, which is taken back
  {
    Hdf5File file = Hdf5File::resume(path);
    file.remove("/more");
    file.reserve_rows("/snapshots/u", {4, 4, 3});
  }
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_FALSE(file.exists("/more"));
  EXPECT_EQ(file.change_note("nobody"), "");
  const auto u = file.read<double>("/snapshots/u", {4, 4, 3});
  for (std::size_t i = 0; i < u.size(); ++i)
    ASSERT_EQ(u[i], 1. * (i / 12));
}

TEST(Hdf5, AnUnfinishedFileKeepsItsPart)
{
  const TemporaryFolder folder;
  const std::string path = folder / "d.h5";
  try
    {
      Hdf5File file = Hdf5File::create(path);
      file.write("/x", {1}, std::vector<double>{1.});
      throw Interrupted("stop");
    }
  catch (const Interrupted &)
    {
    }
  EXPECT_FALSE(std::filesystem::exists(path));
  write_first_line(path + ".part", "unfinished");
  expect_contains(user_error([&]() { Hdf5File::resume(path, "start again"); }),
                  "d.h5.part: its program was killed while it wrote the file, which "
                  "cannot be gone on with; start again");
}

TEST(Hdf5, NamesWhatIsMissingOrDoesNotFit)
{
  const TemporaryFolder folder;
  const std::string path = folder / "rve.h5";
  {
    Hdf5File file = Hdf5File::create(path);
    file.write_header("mesoslip-rve", 3, 2, "abc");
    file.write("/concentration/SUBC", {2, 3}, counted(6));
    file.write("/bad", {2}, std::vector<double>{1., 12345.678});
    file.write<std::string>("/text", {1}, {"a"});
    file.write_attribute("/", "infinite", 8765.4321);
  }
  const std::string finite = read_file(path);
  write_file(path, with_number(with_number(finite, 12345.678, std::nan("")), 8765.4321,
                               std::numeric_limits<double>::infinity()));
  const Hdf5File file = Hdf5File::open(path);
  const auto message  = [&](const auto &action) { return user_error(action); };
  expect_contains(message([&]() {
                    file.read<double>("/concentration/KUBC", {},
                                      "was rve_homogenization run with KUBC?");
                  }),
                  "rve.h5: /concentration/KUBC is missing; was rve_homogenization "
                  "run with KUBC?");
  expect_contains(message([&]() {
                    file.read<double>("/concentration/SUBC", {3, 3});
                  }),
                  "has the shape [2][3] instead of [3][3]");
  expect_contains(message([&]() { file.read<double>("/concentration"); }),
                  "not a dataset");
  expect_contains(message([&]() { file.read<int>("/concentration/SUBC"); }),
                  "whole numbers");
  expect_contains(message([&]() { file.read<double>("/text"); }),
                  "does not hold numbers");
  expect_contains(message([&]() { file.read<std::string>("/bad"); }),
                  "is not a text or a list of texts");
  expect_contains(
    message([&]() { file.read<double>("/bad"); }),
    "the dataset /bad holds a value that is not finite, at position 1 of 2");
  expect_contains(message([&]() { file.read_attribute<double>("/", "infinite"); }),
                  "is not finite");
  expect_contains(message([&]() { file.read_attribute<int>("/", "nothing"); }),
                  "the attribute 'nothing' of / is missing");
  expect_contains(message([&]() { file.read_attribute<double>("/", "digest"); }),
                  "does not hold numbers");
  expect_contains(message([&]() { file.check_header("mesoslip-dynamics", 3); }),
                  "has the format mesoslip-rve instead of mesoslip-dynamics");
  expect_contains(
    message([&]() { file.check_header("mesoslip-rve", 2); }),
    "has version 3 of the format mesoslip-rve, but this program knows versions "
    "1 to 2");
  expect_contains(message([&]() { file.check_header("mesoslip-rve", 3, 3); }), "is 2D");
}

TEST(Hdf5, NamesFilesThatAreNone)
{
  const TemporaryFolder folder;
  const std::string path = folder / "e.h5";
  const auto message     = [&]() {
    return user_error([&]() { Hdf5File::open(path, "run rve_homogenization first"); });
  };
  expect_contains(message(), "e.h5; run rve_homogenization first");
  write_file(path, "text");
  expect_contains(message(), "is not an HDF5 file");
  write_file(path, "");
  expect_contains(message(), "is not an HDF5 file");
  expect_contains(user_error([&]() { Hdf5File::open(folder.path); }), "is a folder");
  expect_contains(user_error([&]() { Hdf5File::create(folder / "no/e.h5"); }),
                  "cannot be created");
  {
    Hdf5File file = Hdf5File::create(path);
    file.write("/field", {1000}, counted(1000));
  }
  const std::string good = read_file(path);
  write_file(path, good.substr(0, good.size() - 4000));
  expect_contains(message(), "truncated, damaged");
  EXPECT_TRUE(user_error([&]() { Hdf5File::open(path); }).find('\n') ==
              std::string::npos);
  Hdf5File file = Hdf5File::create(folder / "f.h5");
  file.close();
  const Hdf5File foreign = Hdf5File::open(folder / "f.h5");
  expect_contains(user_error([&]() { foreign.check_header("mesoslip-rve", 1); }),
                  "is not a file of format mesoslip-rve");
}
