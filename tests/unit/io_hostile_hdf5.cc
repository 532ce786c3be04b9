// HDF5 files that ask for more than they hold, and disks that fill up.
#include "io_testing.h"

#include "io/files.h"
#include "io/hdf5_file.h"

#include <csignal>
#include <hdf5.h>
#include <sys/resource.h>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
/** Writes a dataset without values, of chunks or in another layout, with the library
 * itself. */
void write_hollow(const std::string &path,
                  const hid_t type,
                  const std::vector<hsize_t> &extents,
                  const std::vector<hsize_t> &chunk,
                  const H5D_layout_t layout = H5D_CONTIGUOUS)
{
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_layout(properties, layout);
  if (!chunk.empty())
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data());
  const hid_t space =
    H5Screate_simple(static_cast<int>(extents.size()), extents.data(), nullptr);
  const hid_t set =
    H5Dcreate2(file, "/hollow", type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  ASSERT_GE(set, 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(properties);
  H5Fclose(file);
}

std::string reading(const std::string &path)
{
  return user_error([&]() { Hdf5File::open(path).read<double>("/hollow"); });
}
} // namespace

TEST(HostileHdf5, NothingLargerThanTheFileIsRead)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  const hsize_t huge     = hsize_t(1) << 31;
  // 17 GB that would be filled with zeros.
  write_hollow(path, H5T_NATIVE_DOUBLE, {huge}, {1024});
  expect_contains(reading(path), "/hollow of shape [2147483648] is larger than the file");
  // The product of the extents is 2^64, that is, 0: once an empty list without an error.
  write_hollow(path, H5T_NATIVE_DOUBLE, {huge, huge, 4}, {1, 1024, 1});
  expect_contains(reading(path), "larger than the file");
  // A chunk of 2 GB that the library would fill for the one value that is read.
  write_hollow(path, H5T_NATIVE_DOUBLE, {huge / 8}, {huge / 8});
  expect_contains(
    user_error([&]() { Hdf5File::open(path).read_block<double>("/hollow", {0}, {1}); }),
    "larger than the file");
  write_hollow(path, H5T_C_S1, {huge, huge}, {1024, 1});
  expect_contains(user_error([&]() { Hdf5File::open(path).read_strings("/hollow"); }),
                  "not a list of texts");
  // Well below the limit: unwritten values read as zeros.
  write_hollow(path, H5T_NATIVE_DOUBLE, {1000}, {1000});
  EXPECT_EQ(Hdf5File::open(path).read<double>("/hollow"), std::vector<double>(1000));
}

TEST(HostileHdf5, EmptySpacesAreNamed)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  const hid_t file    = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t nothing = H5Screate(H5S_NULL);
  H5Aclose(H5Acreate2(file, "a", H5T_NATIVE_INT, nothing, H5P_DEFAULT, H5P_DEFAULT));
  H5Dclose(H5Dcreate2(file, "/hollow", H5T_NATIVE_DOUBLE, nothing, H5P_DEFAULT,
                      H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(nothing);
  H5Fclose(file);
  expect_contains(reading(path), "holds nothing");
  expect_contains(
    user_error([&]() { Hdf5File::open(path).read_attribute<int>("/", "a"); }),
    "the attribute 'a' of / has no value");
}

// Found by a fuzzer: a damaged heap, in which they lie, made the library crash, copy
// beyond its memory, or go round for ever.
TEST(HostileHdf5, TextsOfVariableLengthAreNotRead)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  const hid_t file     = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t variable = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
  H5Tset_size(variable, H5T_VARIABLE);
  const char *text      = "text";
  const hid_t attribute = H5Acreate2(file, "a", variable, one, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(attribute, variable, &text), 0);
  H5Aclose(attribute);
  H5Dclose(
    H5Dcreate2(file, "/hollow", variable, one, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  H5Sclose(one);
  H5Tclose(variable);
  H5Fclose(file);
  expect_contains(user_error([&]() { Hdf5File::open(path).read_strings("/hollow"); }),
                  "not a list of texts of fixed length");
  expect_contains(
    user_error([&]() { Hdf5File::open(path).read_attribute<std::string>("/", "a"); }),
    "the attribute 'a' of / is not a text of fixed length");
}

// Found by a fuzzer: of a damaged one the library copied what is not there.
TEST(HostileHdf5, CompactDatasetsAreNotRead)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write_hollow(path, H5T_NATIVE_DOUBLE, {1}, {}, H5D_COMPACT);
  expect_contains(reading(path), "is stored in its header, as no program here does");
}

namespace
{
/** A compression that crashes where the library undoes it: the library itself does so
 * only where its over-reading happens to leave the memory of the process. */
void register_crashing_filter()
{
  H5Z_class2_t filter    = {};
  filter.version         = H5Z_CLASS_T_VERS;
  filter.id              = H5Z_FILTER_RESERVED + 1;
  filter.encoder_present = filter.decoder_present = 1;
  filter.name                                     = "crash";
  filter.filter = [](unsigned int flags, std::size_t, const unsigned int *, std::size_t n,
                     std::size_t *, void **) -> std::size_t {
    if ((flags & H5Z_FLAG_REVERSE) != 0)
      std::raise(SIGSEGV);
    return n;
  };
  ASSERT_GE(H5Zregister(&filter), 0);
}

void write_crashing(const std::string &path)
{
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  const hsize_t one      = 1;
  H5Pset_chunk(properties, 1, &one);
  H5Pset_filter(properties, H5Z_FILTER_RESERVED + 1, 0, 0, nullptr);
  const hid_t space  = H5Screate_simple(1, &one, nullptr);
  const hid_t set    = H5Dcreate2(file, "/hollow", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                                  properties, H5P_DEFAULT);
  const double value = 1.;
  ASSERT_GE(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, &value), 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(properties);
  H5Fclose(file);
}
} // namespace

TEST(HostileHdf5, ACrashOfTheLibraryEndsWithASentence)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  register_crashing_filter();
  write_crashing(path);
  EXPECT_EXIT(Hdf5File::open(path).read<double>("/hollow"), testing::ExitedWithCode(2),
              "a.h5: HDF5 crashes on it, as the file is damaged");
  // What crashes elsewhere is not the fault of the file.
  const auto handler = []() {
    struct sigaction action = {};
    sigaction(SIGSEGV, nullptr, &action);
    return action.sa_handler;
  };
  const auto before = handler();
  EXPECT_EQ(Hdf5File::open(path).shape("/hollow"), Shape{1});
  EXPECT_EQ(handler(), before);
}

namespace
{
/** A file with /group/secret, as somebody else's on the same machine, and what a foreign
 * file would make of it. */
struct ForeignFile
{
  ForeignFile()
  {
    Hdf5File file = Hdf5File::create(secret);
    file.write<double>("/group/secret", {1}, {42.});
    file.close();
  }

  /** The sentence for /link of a file, or for what lies behind it. */
  std::string refusal(const std::string &object = "/link") const
  {
    return user_error([&]() { Hdf5File::open(path).read<double>(object); });
  }

  const TemporaryFolder folder;
  const std::string secret = folder / "secret.h5", path = folder / "a.h5";
};

/** Calls @p write with the identifier of a new file. */
void with_new_file(const std::string &path, const std::function<void(hid_t)> &write)
{
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  write(file);
  H5Fclose(file);
}

/** A dataset /link of one number with these properties; closes them. */
void create_with(const hid_t file, const hid_t properties)
{
  const hsize_t one = 1;
  const hid_t space = H5Screate_simple(1, &one, nullptr);
  const hid_t set   = H5Dcreate2(file, "/link", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT,
                                 properties, H5P_DEFAULT);
  EXPECT_GE(set, 0);
  H5Dclose(set);
  H5Sclose(space);
  H5Pclose(properties);
}
} // namespace

TEST(HostileHdf5, LinksAreNotFollowed)
{
  const ForeignFile foreign;
  const std::string to_other_file = "/link is a link by name";
  with_new_file(foreign.path, [&](const hid_t file) {
    H5Lcreate_external(foreign.secret.c_str(), "/group/secret", file, "/link",
                       H5P_DEFAULT, H5P_DEFAULT);
  });
  expect_contains(foreign.refusal(), to_other_file);
  // A group on the way, and one behind a link within the file.
  with_new_file(foreign.path, [&](const hid_t file) {
    H5Lcreate_external(foreign.secret.c_str(), "/group", file, "/link", H5P_DEFAULT,
                       H5P_DEFAULT);
    H5Lcreate_soft("/link/secret", file, "/soft", H5P_DEFAULT, H5P_DEFAULT);
  });
  expect_contains(foreign.refusal("/link/secret"), to_other_file);
  expect_contains(foreign.refusal("/soft"), "/soft is a link by name");
  const auto listed = [&]() { Hdf5File::open(foreign.path).list("/link"); };
  expect_contains(user_error(listed), to_other_file);
  const auto attribute = [&]() {
    Hdf5File::open(foreign.path).has_attribute("/link/secret", "unit");
  };
  expect_contains(user_error(attribute), to_other_file);
}

TEST(HostileHdf5, DatasetsOfOtherFilesAreNotRead)
{
  const ForeignFile foreign;
  const std::string elsewhere = "the dataset /link has its values outside this file";
  with_new_file(foreign.path, [&](const hid_t file) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(properties, foreign.secret.c_str(), 0, sizeof(double));
    create_with(file, properties);
  });
  expect_contains(foreign.refusal(), elsewhere);
  with_new_file(foreign.path, [&](const hid_t file) {
    const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
    const hsize_t one      = 1;
    const hid_t space      = H5Screate_simple(1, &one, nullptr);
    H5Pset_virtual(properties, space, foreign.secret.c_str(), "/group/secret", space);
    H5Sclose(space);
    create_with(file, properties);
  });
  expect_contains(foreign.refusal(), elsewhere);
}

TEST(HostileHdf5, TextsKeepTheirLength)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  // Longer than the 64 kB that an object's header may have; empty; not ASCII.
  const std::vector<std::string> texts = {std::string(100000, 'x'), "", "\u00b5m"};
  Hdf5File file                        = Hdf5File::create(path);
  file.write_strings("/texts", texts);
  file.write_attribute("/texts", "unit", std::string("\u00b5m"));
  file.write_attribute("/texts", "none", std::string());
  file.close();
  const Hdf5File read = Hdf5File::open(path);
  EXPECT_EQ(read.read_strings("/texts"), texts);
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
    file.create_extendable<double>("/rows", {5000});
    for (unsigned int k = 0; k < 100; ++k)
      file.append<double>("/rows", std::vector<double>(5000).data(), 1);
  });
  // What is buffered fails only when it is flushed.
  expect_full_disk(path, [](Hdf5File &file) {
    for (char name = 'a'; name < 'k'; ++name)
      file.create_extendable<double>(std::string("/") + name, {});
    for (unsigned int k = 0; k < 2000; ++k)
      for (char name = 'a'; name < 'k'; ++name)
        file.append(std::string("/") + name, 1. * k);
  });
  expect_full_disk(path, [](Hdf5File &file) {
    file.write_strings("/names", std::vector<std::string>(100000, "fibre"));
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
