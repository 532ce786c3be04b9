// Exchange files: round trips, what is said about foreign or damaged ones, and what
// protects their numbers: checksum, UTF-8, nothing that is not finite.
#include "io_testing.h"

#include "base/files.h"
#include "io/hdf5/internal.h"

#include <cmath>
#include <limits>

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

/** Gives an attribute of the root another value, as other programs may. */
void overwrite_attribute(const std::string &path, const char *name, const double value)
{
  const hid_t file      = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(file, name, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value), 0);
  H5Aclose(attribute);
  H5Fclose(file);
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
  expect_error("has the shape [5][4][3][2], which does not hold [1][4][3][2]", [&] {
    file.read_block<double>("/field", {5, 0, 0, 0}, {1, 4, 3, 2});
  });
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
  expect_error("d.h5.part: its program was killed while it wrote the file, which "
               "cannot be gone on with; start again",
               [&] { Hdf5File::resume(path, "start again"); });
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
  write_file(path, with_number(read_file(path), 12345.678, std::nan("")));
  overwrite_attribute(path, "infinite", std::numeric_limits<double>::infinity());
  const Hdf5File file = Hdf5File::open(path);
  expect_error("rve.h5: /concentration/KUBC is missing; was rve_homogenization "
               "run with KUBC?",
               [&] {
                 file.read<double>("/concentration/KUBC", {},
                                   "was rve_homogenization run with KUBC?");
               });
  expect_error("has the shape [2][3] instead of [3][3]", [&] {
    file.read<double>("/concentration/SUBC", {3, 3});
  });
  expect_error("not a dataset", [&] { file.read<double>("/concentration"); });
  expect_error("whole numbers", [&] { file.read<int>("/concentration/SUBC"); });
  expect_error("does not hold numbers", [&] { file.read<double>("/text"); });
  expect_error("is not a text or a list of texts",
               [&] { file.read<std::string>("/bad"); });
  expect_error("the dataset /bad holds a value that is not finite, at position 1 of 2",
               [&] { file.read<double>("/bad"); });
  expect_error("is not finite", [&] { file.read_attribute<double>("/", "infinite"); });
  expect_error("the attribute 'nothing' of / is missing",
               [&] { file.read_attribute<int>("/", "nothing"); });
  expect_error("does not hold numbers",
               [&] { file.read_attribute<double>("/", "digest"); });
  expect_error("has the format mesoslip-rve instead of mesoslip-dynamics",
               [&] { file.check_header("mesoslip-dynamics", 3); });
  expect_error(
    "has version 3 of the format mesoslip-rve, but this program knows versions "
    "1 to 2",
    [&] { file.check_header("mesoslip-rve", 2); });
  expect_error("is 2D", [&] { file.check_header("mesoslip-rve", 3, 3); });
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
  expect_error("is a folder", [&] { Hdf5File::open(folder.path); });
  expect_error("cannot be created", [&] { Hdf5File::create(folder / "no/e.h5"); });
  {
    Hdf5File file = Hdf5File::create(path);
    file.write("/field", {1000}, counted(1000));
  }
  const std::string good = read_file(path);
  write_file(path, good.substr(0, good.size() - 4000));
  expect_contains(message(), "truncated, damaged");
  expect_error("truncated, damaged", [&] { Hdf5File::resume(path); });
  EXPECT_TRUE(std::filesystem::exists(path)); // under its name
  write_file(folder / "v5.mat", "MATLAB 5.0 MAT-file");
  expect_error("before 7.3", [&] { Hdf5File::open(folder / "v5.mat"); });
  EXPECT_TRUE(user_error([&]() { Hdf5File::open(path); }).find('\n') ==
              std::string::npos);
  Hdf5File file = Hdf5File::create(folder / "f.h5");
  file.close();
  const Hdf5File foreign = Hdf5File::open(folder / "f.h5");
  expect_error("is not a file of format mesoslip-rve",
               [&] { foreign.check_header("mesoslip-rve", 1); });
}

TEST(Hdf5Signature, LineAndBlockAreThoseOfTheFormat)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  {
    Hdf5File file = Hdf5File::create(path);
    file.write_header("mesoslip-rve", 1, 2, "abc");
    file.write("/stiffness", {3}, std::vector<double>{1e9, 12345.678, 3e9});
    file.close();
  }
  const std::string bytes = read_file(path);
  EXPECT_EQ(bytes.substr(0, 22), "mesoslip-rve xxh3-128 ");
  EXPECT_EQ(bytes.find('\n'), 22u + 32u);
  EXPECT_EQ(bytes.substr(512, 4), "\x89HDF");
  EXPECT_EQ(Hdf5File::open(path).change_note("nobody"), "");
  write_file(path, with_number(bytes, 12345.678, 2. * 12345.678));
  EXPECT_EQ(Hdf5File::open(path).change_note("rve_homogenization"),
            path + " has changed since rve_homogenization wrote it, by an edit or by "
                   "damage; its numbers are used as they are");
  EXPECT_EQ(Hdf5File::open(path).changed_content().size(), 32u);
  expect_error("has changed since it was written", [&] { Hdf5File::resume(path); });
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  write_file(path, bytes);
  EXPECT_EQ(Hdf5File::open(path).changed_content(), "");
  Hdf5File::resume(path).close();
  // Of no bytes at all, from the specification of XXH3.
  write_file(path, std::string(512, '\0'));
  sign_file(path, "x");
  EXPECT_EQ(read_file(path).substr(0, 43), "x xxh3-128 99aa06d3014798d86001c324468d497f");
}

TEST(Hdf5Contents, NumbersThatAreNotFiniteAreNotWritten)
{
  const TemporaryFolder folder;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto failure        = [&](const std::function<void(Hdf5File &)> &write) {
    try
      {
        Hdf5File file = Hdf5File::create(folder / "a.h5");
        write(file);
        file.close();
      }
    catch (const NumericalFailure &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  expect_contains(failure([&](Hdf5File &file) {
                    file.write("/field", {3}, std::vector<double>{0., 1., infinite});
                  }),
                  "a.h5: the dataset /field would hold a value that is not finite, at "
                  "position 2 of 3");
  expect_contains(failure([&](Hdf5File &file) {
                    file.write("/field", {1}, std::vector<float>{std::nanf("")});
                  }),
                  "the dataset /field would hold");
  expect_contains(failure([&](Hdf5File &file) {
                    file.reserve_rows("/rows", {1, 2});
                    file.write_row("/rows", 0, {0., -infinite});
                  }),
                  "the dataset /rows would hold");
  expect_contains(
    failure([&](Hdf5File &file) { file.write_attribute("/", "initial", std::nan("")); }),
    "the attribute 'initial' of / would hold");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(Hdf5Contents, TextsAndNamesAreUtf8)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5", latin = "fibre \xe9";
  {
    Hdf5File file = Hdf5File::create(path);
    file.write<std::string>("/name", {2}, {"matrix", latin});
    file.write_attribute("/name", "unit", latin);
    file.create_group("/probes/" + latin);
  }
  const Hdf5File file = Hdf5File::open(path);
  expect_error("the dataset /name holds a text that is not UTF-8",
               [&] { file.read<std::string>("/name"); });
  expect_error("is not UTF-8",
               [&] { file.read_attribute<std::string>("/name", "unit"); });
  expect_error("the name of a member of /probes is not UTF-8",
               [&] { file.list("/probes"); });
}

TEST(Hdf5Contents, TextsKeepTheirLength)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  // Longer than the 64 kB that an object's header may have; empty; not ASCII.
  const std::vector<std::string> texts = {std::string(100000, 'x'), "", "\u00b5m"};
  Hdf5File file                        = Hdf5File::create(path);
  file.write("/texts", {3}, texts);
  file.write_attribute("/texts", "unit", std::string("\u00b5m"));
  file.write_attribute("/texts", "none", std::string());
  file.close();
  const Hdf5File read = Hdf5File::open(path);
  EXPECT_EQ(read.read<std::string>("/texts"), texts);
  EXPECT_EQ(read.read_attribute<std::string>("/texts", "unit"), "\u00b5m");
  EXPECT_EQ(read.read_attribute<std::string>("/texts", "none"), "");
}
