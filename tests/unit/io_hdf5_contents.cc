// What protects the numbers in HDF5 files: checksum, units, UTF-8, nothing that is not
// finite; files of other libraries, and disks that fill up.
#include "io_testing.h"

#include "base/files.h"
#include "io/hdf5/internal.h"

#include <cmath>
#include <csignal>
#include <hdf5.h>
#include <limits>
#include <sys/resource.h>

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
  EXPECT_EQ(note(path), path + " has changed since rve_homogenization wrote it, by an "
                               "edit or by damage; its numbers are used as they are");
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
                    file.reserve_rows("/rows", {1, 2});
                    file.write_row("/rows", 0, {0., -infinite});
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
    file.write<std::string>("/name", {2}, {"matrix", latin});
    file.write_attribute("/name", "unit", latin);
    file.create_group("/probes/" + latin);
  }
  const Hdf5File file = Hdf5File::open(path);
  expect_contains(user_error([&]() { file.read<std::string>("/name"); }),
                  "the dataset /name holds a text that is not UTF-8");
  expect_contains(
    user_error([&]() { file.read_attribute<std::string>("/name", "unit"); }),
    "is not UTF-8");
  expect_contains(user_error([&]() { file.list("/probes"); }),
                  "the name of a member of /probes is not UTF-8");
}

namespace
{
/** A file as h5py or another library may write it: of the newest kind, with the order of
 *  its members kept, texts of variable length, and values that are not there. */
void write_foreign(const std::string &path)
{
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS), creation = H5Pcreate(H5P_FILE_CREATE);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
  const hid_t one = H5Screate(H5S_SCALAR), none = H5Screate(H5S_NULL);
  const hsize_t two = 2;
  const hid_t pair = H5Screate_simple(1, &two, nullptr), variable = H5Tcopy(H5T_C_S1);
  H5Tset_size(variable, H5T_VARIABLE);
  const char *texts[] = {"\u00b5m", ""};
  const hid_t attribute =
    H5Acreate2(file, "unit", variable, one, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, variable, texts), 0);
  const hid_t names =
    H5Dcreate2(file, "/name", variable, pair, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(names, variable, H5S_ALL, H5S_ALL, H5P_DEFAULT, texts), 0);
  const hid_t compact = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_layout(compact, H5D_COMPACT);
  const double values[] = {1., 2.};
  const hid_t numbers =
    H5Dcreate2(file, "/number", H5T_IEEE_F64BE, pair, H5P_DEFAULT, compact, H5P_DEFAULT);
  EXPECT_GE(H5Dwrite(numbers, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values),
            0);
  const hid_t empty =
    H5Acreate2(file, "empty", H5T_NATIVE_INT, none, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(empty, 0);
  H5Lcreate_soft("/nowhere", file, "/dangling", H5P_DEFAULT, H5P_DEFAULT);
  for (const hid_t id : {access, creation, one, none, pair, variable, attribute, names,
                         compact, numbers, empty, file})
    H5Idec_ref(id);
}
} // namespace

TEST(Hdf5Contents, FilesOfOtherLibrariesAreRead)
{
  const TemporaryFolder folder;
  write_foreign(folder / "a.h5");
  const Hdf5File file = Hdf5File::open(folder / "a.h5");
  expect_contains(file.change_note("rve_homogenization"), "has no checksum");
  EXPECT_EQ(file.read_attribute<std::string>("/", "unit"), "\u00b5m");
  EXPECT_EQ(file.read<std::string>("/name"), (std::vector<std::string>{"\u00b5m", ""}));
  EXPECT_EQ(file.read<double>("/number"), (std::vector<double>{1., 2.}));
  expect_contains(user_error([&]() { file.read_attribute<int>("/", "empty"); }),
                  "the attribute 'empty' of / holds nothing");
  expect_contains(user_error([&]() { file.read<double>("/dangling"); }),
                  "/dangling cannot be opened");
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

namespace
{
/** A limit of the file size acts as a full disk does: a write fails. */
void limit_file_size(const rlim_t bytes)
{
  std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit limit;
  getrlimit(RLIMIT_FSIZE, &limit);
  limit.rlim_cur = bytes;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

/** Writes more than the disk takes in a process of its own, which has to end in order. */
void expect_full_disk(const std::string &path,
                      const std::function<void(Hdf5File &)> &write)
{
  const auto fill = [&]() {
    limit_file_size(100000);
    try
      {
        Hdf5File file = Hdf5File::create(path);
        write(file);
        file.close();
      }
    catch (const UserError &error)
      {
        std::cerr << error.what() << std::endl;
        // As the programs do: otherwise the library crashes in its exit handler.
        std::_Exit(Hdf5File::writing_has_failed() ? 2 : 1);
      }
    std::_Exit(0);
  };
  EXPECT_EXIT(fill(), ::testing::ExitedWithCode(2), "is the disk full");
}
} // namespace

TEST(FullDisk, IsAnErrorAndKeepsTheOldFile)
{
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  {
    Hdf5File file = Hdf5File::create(path);
    file.write<double>("/x", {3}, {1., 2., 3.});
    file.close();
  }
  const std::string old = read_file(path);
  expect_full_disk(path, [](Hdf5File &file) {
    file.write<double>("/y", {100000}, std::vector<double>(100000));
  });
  expect_full_disk(path, [](Hdf5File &file) {
    file.reserve_rows("/rows", {100, 5000});
    for (unsigned int k = 0; k < 100; ++k)
      file.write_row("/rows", k, std::vector<double>(5000));
  });
  // What is buffered fails only when it is flushed.
  expect_full_disk(path, [](Hdf5File &file) {
    for (unsigned int k = 0; k < 1000; ++k)
      file.create_group("/group" + std::to_string(k));
  });
  expect_full_disk(path, [](Hdf5File &file) {
    file.write("/names", {100000}, std::vector<std::string>(100000, "fibre"));
  });
  EXPECT_EQ(read_file(path), old);
  EXPECT_EQ(Hdf5File::open(path).read<double>("/x"), (std::vector<double>{1., 2., 3.}));
}

TEST(FullDisk, OfSmallFiles)
{
  ::testing::FLAGS_gtest_death_test_style = "threadsafe";
  const TemporaryFolder folder;
  write_file(folder / "a.txt", "old");
  const auto fill = [&]() {
    limit_file_size(4096);
    try
      {
        write_file(folder / "a.txt", std::string(10000, 'x'));
      }
    catch (const UserError &error)
      {
        std::cerr << error.what() << std::endl;
        std::exit(2);
      }
  };
  EXPECT_EXIT(fill(), ::testing::ExitedWithCode(2),
              "a.txt.part: cannot be written .File too large");
  EXPECT_EQ(read_file(folder / "a.txt"), "old");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.part"));
}
