// What protects the numbers in HDF5 files: checksum, units, UTF-8, nothing that is not
// finite.
#include "io_testing.h"

#include "io/files.h"
#include "io/hdf5_file.h"

#include <cmath>
#include <hdf5.h>
#include <limits>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
void write_small(const std::string &path)
{
  Hdf5File file = Hdf5File::create(path);
  file.write_header("mesoslip-rve", 1, 2, "abc");
  file.write("/stiffness", {3}, std::vector<double>{1e9, 12345.678, 3e9});
  file.write_unit("/stiffness", "Pa");
  file.close();
}

std::string note(const std::string &path)
{
  return Hdf5File::open(path).change_note("rve_homogenization");
}
} // namespace

TEST(Hdf5Signature, LineAndBlockAreThoseOfTheFormat)
{
  const TemporaryFolder folder;
  write_small(folder / "a.h5");
  const std::string bytes = read_file(folder / "a.h5");
  EXPECT_EQ(bytes.substr(0, 22), "mesoslip-rve xxh3-128 ");
  EXPECT_EQ(bytes.find('\n'), 22u + 32u);
  EXPECT_EQ(bytes.substr(512, 4), "\x89HDF");
  // Of no bytes at all, from the specification of XXH3.
  write_file(folder / "empty", std::string(512, '\0'));
  sign_file(folder / "empty", "x");
  EXPECT_EQ(read_file(folder / "empty").substr(0, 43),
            "x xxh3-128 99aa06d3014798d86001c324468d497f");
}

TEST(Hdf5Signature, EachChangeIsNoticed)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write_small(path);
  EXPECT_EQ(note(path), "");
  const std::string good = read_file(path);

  write_file(path, with_number(good, 12345.678, 2. * 12345.678));
  EXPECT_EQ(note(path), path + " has changed since rve_homogenization wrote it; its "
                               "numbers are used as they are");
  EXPECT_EQ(Hdf5File::open(path).read<double>("/stiffness")[1], 2. * 12345.678);

  std::string flipped = good;
  flipped.back() = static_cast<char>(flipped.back() ^ 1); // nobody's byte, in any case
  write_file(path, flipped);
  expect_contains(note(path), "has changed since");

  // By the library, as h5py does it.
  write_file(path, good);
  const hid_t file      = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const hid_t set       = H5Dopen2(file, "/stiffness", H5P_DEFAULT);
  const double values[] = {1., 2., 3.};
  H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
  H5Dclose(set);
  H5Fclose(file);
  expect_contains(note(path), "has changed since");

  // Another version's line, and a file without one.
  write_file(path, std::string(512, ' ') + good.substr(512));
  expect_contains(note(path), "has no checksum");
  write_file(path, good);
  EXPECT_EQ(note(path), "");
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
                    const double row[] = {0., -infinite};
                    file.create_extendable<double>("/rows", {2});
                    file.append("/rows", row, 1);
                  }),
                  "the dataset /rows would hold");
  expect_contains(
    failure([&](Hdf5File &file) { file.write_attribute("/", "initial", std::nan("")); }),
    "the attribute 'initial' of / would hold");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.h5"));
}

TEST(Hdf5Contents, OtherUnitsAreRefused)
{
  const TemporaryFolder folder;
  write_small(folder / "a.h5");
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  file.require_unit("/stiffness", "Pa");
  expect_contains(user_error([&]() { file.require_unit("/stiffness", "GPa"); }),
                  "the dataset /stiffness has the unit 'Pa' instead of 'GPa'");
}

TEST(Hdf5Contents, TextsAndNamesAreUtf8)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5", latin = "fibre \xe9";
  {
    Hdf5File file = Hdf5File::create(path);
    file.write_strings("/name", {"matrix", latin});
    file.write_attribute("/name", "unit", latin);
    file.create_group("/probes/" + latin);
  }
  const Hdf5File file = Hdf5File::open(path);
  expect_contains(user_error([&]() { file.read_strings("/name"); }),
                  "the dataset /name holds a text that is not UTF-8");
  expect_contains(
    user_error([&]() { file.read_attribute<std::string>("/name", "unit"); }),
    "is not UTF-8");
  expect_contains(user_error([&]() { file.list("/probes"); }),
                  "the name of a member of /probes is not UTF-8");
}
