// Damaged structures of HDF5 files, byte by byte: nothing of them is given to the
// library.
#include "io_testing.h"

#include "io/files.h"
#include "io/hdf5_file.h"

#include <functional>
#include <hdf5.h>

using namespace mesoslip;
using namespace mesoslip_tests;

namespace
{
/** A file that is written once, and changed in some bytes for each expectation. */
class ChangedFile
{
public:
  explicit ChangedFile(const std::function<void(Hdf5File &)> &write)
    : path(folder / "a.h5")
  {
    Hdf5File file = Hdf5File::create(path);
    write(file);
    file.close();
    original = changed = read_file(path);
  }

  std::size_t position_of(const std::string &part) const
  {
    const std::size_t position = original.find(part);
    EXPECT_NE(position, std::string::npos);
    return position;
  }

  char byte(const std::size_t position) const
  {
    return original.at(position);
  }

  /** A number of so many bytes, the least one first. */
  ChangedFile &
  set(const std::size_t position, const std::size_t value, const std::size_t n_bytes = 1)
  {
    for (std::size_t k = 0; k < n_bytes; ++k)
      changed.at(position + k) = static_cast<char>(value >> 8 * k & 0xff);
    return *this;
  }

  /** Opens what set() has made since the last time: this is wrong with it. */
  void expect(const std::string &problem)
  {
    write_file(path, changed);
    changed = original;
    expect_contains(user_error([&]() { Hdf5File::open(path); }),
                    "written by another program (" + problem);
  }

  Hdf5File unchanged() const
  {
    write_file(path, original);
    return Hdf5File::open(path);
  }

private:
  const TemporaryFolder folder;
  const std::string path;
  std::string original, changed;
};
} // namespace

namespace
{
/** Where the parts of the attribute `hostile` lie, from its
 * name. */
enum Part
{
  name_size  = -6,
  type_size  = -4,
  space_size = -2,
  name_end   = 7,
  type_class = 8,
  value_size = 12,
  bit_offset = 16,
  precision  = 18,
  space      = 24,
  rank       = 25,
  extent     = 32
};
} // namespace

// Found by a fuzzer: the library copied as much as the attribute says from behind it,
// here 16 MB.
TEST(HostileHdf5, DamagedAttributesAreNotDecoded)
{
  ChangedFile file([](Hdf5File &target) {
    target.write_attribute("/", "hostile", std::vector<int>{1, 2, 3});
  });
  const std::size_t name = file.position_of("hostile");
  const auto expect = [&](const int part, const std::size_t byte, const char *problem) {
    file.set(name + part, byte).expect(std::string("an attribute of / ") + problem);
  };
  expect(extent + 2, 0x40, "has more values than fit in it");
  expect(extent, 100, "has more values than fit in it");
  expect(extent, 0xff, "has more values than fit in it");
  expect(value_size, 8, "has damaged numbers");
  expect(value_size, 0, "has a damaged type");
  expect(bit_offset, 1, "has damaged numbers");
  expect(precision + 1, 1, "has damaged numbers");
  expect(name_size + 1, 0xff, "is longer than its place");
  expect(type_size + 1, 0xff, "is longer than its place");
  expect(space_size + 1, 0xff, "is longer than its place");
  expect(type_size, 8, "is longer than its place");
  expect(name_end, 'x', "has a name without end");
  expect(type_class, 0x16, "is neither a number nor a text");
  expect(space, 9, "has damaged extents");
  expect(rank, 33, "has damaged extents");
  expect(rank, 2, "is longer than its place");
  EXPECT_EQ(file.unchanged().read_attribute<std::vector<int>>("/", "hostile"),
            (std::vector<int>{1, 2, 3}));
}

// Found by a fuzzer: free space in a circle took all memory, names beyond the list were
// read.
TEST(HostileHdf5, DamagedGroupsAreNotOpened)
{
  ChangedFile file([](Hdf5File &target) {
    target.write<double>("/group/numbers", {100}, std::vector<double>(100), 1);
  });
  const auto expect = [&](const std::string &signature, const std::size_t offset,
                          const std::size_t byte, const char *problem) {
    file.set(file.position_of(signature) + offset, byte)
      .expect(std::string("the list of ") + problem);
  };
  expect("HEAP", 16, 0, "members of / has damaged names");
  expect("HEAP", 10, 0xff, "members of / lies beyond the end");
  expect("HEAP", 0, 'h', "members of / is not where something else refers to it");
  expect("TREE", 5, 1, "members of / is not where something else refers to it");
  expect("TREE", 6, 0xff, "members of / is a damaged tree");
  expect("SNOD", 9, 0xff, "members of / has a name without end");
  expect("SNOD", 6, 0xff, "members of / is a damaged tree");
  const std::string chunks("TREE\x01", 5);
  expect(chunks, 5, 1, "chunks of /group/numbers lies beyond the end");
  expect(chunks, 27, 0xff, "chunks of /group/numbers lies beyond the end");
  // A node that is its own child.
  const std::size_t node = file.position_of("TREE");
  file.set(node + 5, 1)
    .set(node + 32, node - signature_bytes, 8)
    .expect("the list of members of / is a damaged tree)");
}

// Found by a fuzzer: for other places of the bits the library looked beyond the number.
TEST(HostileHdf5, DamagedNumbersAreNotOpened)
{
  ChangedFile file([](Hdf5File &target) {
    target.write<double>("/numbers", {2}, {1., 2.});
  });
  const std::size_t type = file.position_of(std::string("\x11\x20\x3f\0\x08\0\0\0", 8));
  for (const std::size_t part : {2, 4, 8, 10, 12, 13, 14, 15})
    file.set(type + part, static_cast<unsigned char>(file.byte(type + part) + 1))
      .expect("the header of /numbers has damaged numbers)");
}

TEST(HostileHdf5, HeadersThatContinueInThemselvesAreNotOpened)
{
  ChangedFile file([](Hdf5File &target) {
    for (int k = 0; k < 20; ++k)
      target.write_attribute("/", std::to_string(k), k);
  });
  // Type and size of the message, then flags, address and size of the next block.
  const std::size_t message = file.position_of(std::string("\x10\0\x10\0", 4));
  file.set(message + 8, message - signature_bytes, 8)
    .set(message + 16, 24, 8)
    .expect("the header of / goes round in a circle)");
}

TEST(HostileHdf5, FilesOfOtherKindsAreNotOpened)
{
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  const hid_t access     = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_LATEST, H5F_LIBVER_LATEST);
  H5Fclose(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access));
  H5Pclose(access);
  expect_contains(user_error([&]() { Hdf5File::open(path).has_attribute("/", "any"); }),
                  "the superblock of / is of a kind that no program here writes");
}
