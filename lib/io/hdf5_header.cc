#include "io/hdf5_header.h"

#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

// Names of fields and numbers of messages are those of the "HDF5 File Format
// Specification Version 3.0", IV.A. All numbers are little-endian.
namespace mesoslip
{
namespace hdf5
{
namespace
{
/** What is wrong; never leaves this file. */
struct Problem
{
  std::string text;
};

void require(const bool holds, const char *problem)
{
  if (!holds)
    throw Problem{problem};
}

/** Bytes that are taken from the front; taking more than there are is a Problem. */
class Bytes
{
public:
  Bytes(const unsigned char *begin, const std::size_t size)
    : begin(begin)
    , size(size)
  {
  }

  std::size_t left() const
  {
    return size;
  }

  Bytes take(const std::size_t n)
  {
    require(n <= size, "is longer than its place");
    const Bytes taken(begin, n);
    begin += n;
    size -= n;
    return taken;
  }

  std::uint64_t number(const std::size_t n_bytes)
  {
    const Bytes taken   = take(n_bytes);
    std::uint64_t value = 0;
    for (std::size_t k = n_bytes; k-- > 0;)
      value = value << 8 | taken.begin[k];
    return value;
  }

  bool has_zero() const
  {
    return std::find(begin, begin + size, 0) != begin + size;
  }

private:
  const unsigned char *begin;
  std::size_t size;
};

/** Sizes of messages have 16 bits; no attribute is larger. */
constexpr std::uint64_t size_limit = 1 << 16;

/** Datatype message: bytes of a value. Numbers and texts, of fixed or variable length. */
std::uint64_t check_datatype(Bytes bytes, const bool in_variable_length = false)
{
  const std::uint64_t class_and_version = bytes.number(1),
                      version           = class_and_version >> 4;
  bytes.take(3);
  const std::uint64_t value_bytes = bytes.number(4);
  require(version >= 1 && version <= 3 && value_bytes > 0 && value_bytes <= size_limit,
          "has a damaged type");
  enum : std::uint64_t
  {
    fixed_point     = 0,
    floating_point  = 1,
    text            = 3,
    variable_length = 9
  };
  switch (class_and_version & 0xf)
    {
    case fixed_point:
      bytes.take(4);
      break;
    case floating_point:
      bytes.take(12);
      break;
    case text:
      break;
    case variable_length:
      require(!in_variable_length, "has a type that no program here writes");
      check_datatype(bytes, true);
      break;
    default:
      throw Problem{"is neither a number nor a text"};
    }
  return value_bytes;
}

/** Dataspace message: number of values, at most size_limit. */
std::uint64_t check_dataspace(Bytes bytes)
{
  const std::uint64_t version = bytes.number(1), rank = bytes.number(1),
                      flags = bytes.number(1);
  require((version == 1 || version == 2) && flags <= 1 && rank <= 32,
          "has damaged extents");
  constexpr std::uint64_t null = 2;
  const std::uint64_t kind     = bytes.number(version == 1 ? 5 : 1);
  std::uint64_t n              = version == 2 && kind == null ? 0 : 1;
  for (std::uint64_t axis = 0; axis < rank; ++axis)
    {
      const std::uint64_t extent = bytes.number(8);
      require(extent <= size_limit, "has more values than fit in it");
      n = std::min(n * extent, size_limit + 1);
    }
  bytes.take(8 * rank * flags);
  require(n <= size_limit, "has more values than fit in it");
  return n;
}

/** Attribute message: its parts lie in it. */
void check_attribute(Bytes bytes)
{
  const std::uint64_t version = bytes.number(1), flags = bytes.number(1);
  require(version >= 1 && version <= 3 && (version == 1 || flags == 0),
          "is of a kind that no program here writes");
  const std::size_t alignment = version == 1 ? 8 : 1;
  std::size_t sizes[3];
  for (std::size_t &size : sizes)
    size = bytes.number(2);
  if (version == 3)
    bytes.take(1);
  std::vector<Bytes> parts;
  for (const std::size_t size : sizes)
    parts.push_back(bytes.take((size + alignment - 1) / alignment * alignment));
  require(parts[0].has_zero(), "has a name without end");
  require(check_datatype(parts[1]) * check_dataspace(parts[2]) <= bytes.left(),
          "has more values than fit in it");
}

/** The messages of a version 1 object header, in one block or several. */
class ObjectHeader
{
public:
  ObjectHeader(const int file, const std::uint64_t file_bytes)
    : file(file)
    , file_bytes(file_bytes)
  {
  }

  void check(const std::uint64_t address)
  {
    constexpr std::uint64_t prefix = 16;
    const auto head                = read(address, prefix);
    Bytes bytes(head.data(), head.size());
    require(bytes.number(1) == 1, "is in a header of a kind that no program here writes");
    bytes.take(7);
    blocks.emplace_back(address + prefix, bytes.number(4));
    // Blocks that name one another would go on for ever.
    constexpr std::size_t most_blocks = 4096;
    for (std::size_t k = 0; k < blocks.size() && k < most_blocks; ++k)
      {
        const auto block = read(blocks[k].first, blocks[k].second);
        check_messages(Bytes(block.data(), block.size()));
      }
    require(blocks.size() <= most_blocks, "is in a header without end");
  }

private:
  std::vector<unsigned char> read(const std::uint64_t address,
                                  const std::uint64_t n) const
  {
    require(n <= file_bytes && address <= file_bytes - n,
            "is in a header beyond the file");
    std::vector<unsigned char> bytes(n);
    require(pread(file, bytes.data(), n, static_cast<off_t>(address)) ==
              static_cast<ssize_t>(n),
            "is in a header that cannot be read");
    return bytes;
  }

  void check_messages(Bytes block)
  {
    constexpr std::size_t message_prefix = 8;
    while (block.left() >= message_prefix)
      {
        const std::uint64_t type = block.number(2), size = block.number(2),
                            flags = block.number(1);
        block.take(3);
        check_message(type, flags, block.take(size));
      }
  }

  void check_message(const std::uint64_t type, const std::uint64_t flags, Bytes body)
  {
    enum : std::uint64_t
    {
      attribute      = 0x0c,
      continuation   = 0x10,
      attribute_info = 0x15,
      shared         = 2 // flag
    };
    require(type != attribute_info && (type != attribute || (flags & shared) == 0),
            "is of a kind that no program here writes");
    if (type == attribute)
      check_attribute(body);
    else if (type == continuation)
      {
        const std::uint64_t address = body.number(8);
        blocks.emplace_back(address, body.number(8));
      }
  }

  const int file;
  const std::uint64_t file_bytes;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> blocks; // address and bytes
};

/** Sizes of addresses and lengths other than 8, or bytes ahead of the file proper. */
bool is_unusual(const hid_t file)
{
  const Handle properties(H5Fget_create_plist(file));
  std::size_t address_bytes = 0, length_bytes = 0;
  hsize_t user_block = 0;
  return H5Pget_sizes(properties, &address_bytes, &length_bytes) < 0 ||
         H5Pget_userblock(properties, &user_block) < 0 || address_bytes != 8 ||
         length_bytes != 8 || user_block != 0;
}
} // namespace

std::string attribute_problem(const hid_t object)
{
  const Handle file(H5Iget_file_id(object));
  H5O_info_t info;
  hsize_t file_bytes = 0;
  void *descriptor   = nullptr;
  if (is_unusual(file) || H5Oget_info2(object, &info, H5O_INFO_BASIC) < 0 ||
      H5Fget_filesize(file, &file_bytes) < 0 ||
      H5Fget_vfd_handle(file, H5P_DEFAULT, &descriptor) < 0)
    return "is in a file of a kind that no program here writes";
  try
    {
      ObjectHeader(*static_cast<const int *>(descriptor), file_bytes).check(info.addr);
    }
  catch (const Problem &problem)
    {
      return problem.text;
    }
  return "";
}
} // namespace hdf5
} // namespace mesoslip
