#include "io/hdf5/messages.h"

#include <algorithm>
#include <array>

namespace mesoslip
{
namespace hdf5
{
namespace
{
/** Sizes of messages have 16 bits; no attribute is larger. */
constexpr std::uint64_t size_limit = 1 << 16;

enum : std::uint64_t
{
  fixed_point     = 0,
  floating_point  = 1,
  text            = 3,
  variable_length = 9
};

/** Whole numbers fill their bytes: from others the library takes bits beyond them. */
void check_fixed_point(Bytes properties, const std::uint64_t value_bytes)
{
  const std::uint64_t offset    = properties.number(2);
  const std::uint64_t precision = properties.number(2);
  require(value_bytes <= 8 && offset == 0 && precision == 8 * value_bytes,
          "has damaged numbers");
}

/** IEEE 754, of 16, 32 or 64 bits. @p flags: the class bit field. */
void check_floating_point(Bytes properties,
                          const std::uint64_t flags,
                          const std::uint64_t value_bytes)
{
  require(value_bytes == 2 || value_bytes == 4 || value_bytes == 8,
          "has damaged numbers");
  const std::uint64_t bits     = 8 * value_bytes;
  const std::uint64_t exponent = value_bytes == 2 ? 5 : value_bytes == 4 ? 8 : 11;
  constexpr std::uint64_t vax  = 0x40;
  // Sign, then exponent, then mantissa.
  require((flags & vax) == 0 && flags >> 8 == bits - 1 && properties.number(2) == 0 &&
            properties.number(2) == bits && properties.number(1) == bits - 1 - exponent &&
            properties.number(1) == exponent && properties.number(1) == 0 &&
            properties.number(1) == bits - 1 - exponent,
          "has damaged numbers");
}

/** Datatype message: bytes of a value. */
std::uint64_t check_datatype(Bytes bytes, const bool in_variable_length = false)
{
  const std::uint64_t class_and_version = bytes.number(1);
  const std::uint64_t version           = class_and_version >> 4;
  const std::uint64_t flags             = bytes.number(3);
  const std::uint64_t value_bytes       = bytes.number(4);
  require(version >= 1 && version <= 3 && value_bytes > 0, "has a damaged type");
  switch (class_and_version & 0xf)
    {
    case fixed_point:
      check_fixed_point(bytes, value_bytes);
      break;
    case floating_point:
      check_floating_point(bytes, flags, value_bytes);
      break;
    case text:
      break;
    case variable_length:
      require(!in_variable_length, other_kind);
      check_datatype(bytes, true);
      break;
    default:
      throw Damage{"is neither a number nor a text"};
    }
  return value_bytes;
}

/** Dataspace message: number of values, at most size_limit. */
std::uint64_t check_dataspace(Bytes bytes)
{
  const std::uint64_t version = bytes.number(1);
  const std::uint64_t rank    = bytes.number(1);
  const std::uint64_t flags   = bytes.number(1);
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
} // namespace

void check_attribute(Bytes message)
{
  const std::uint64_t version = message.number(1);
  const std::uint64_t flags   = message.number(1);
  require(version >= 1 && version <= 3 && (version == 1 || flags == 0), other_kind);
  const std::size_t alignment = version == 1 ? 8 : 1;
  std::array<std::size_t, 3> sizes;
  for (std::size_t &size : sizes)
    size = message.number(2);
  if (version == 3)
    message.take(1);
  const auto part = [&](const std::size_t k) {
    return message.take((sizes[k] + alignment - 1) / alignment * alignment);
  };
  require(part(0).has_zero(), "has a name without end");
  const std::uint64_t value_bytes = check_datatype(part(1));
  require(value_bytes * check_dataspace(part(2)) <= message.left(),
          "has more values than fit in it");
}

void check_dataset_type(Bytes message)
{
  const std::uint64_t kind = Bytes(message).number(1) & 0xf;
  if (kind == fixed_point || kind == floating_point || kind == text)
    check_datatype(message);
}

void check_link_info(Bytes message)
{
  message.take(1);
  const std::uint64_t flags = message.number(1);
  message.take(8 * (flags & 1));
  require(message.number(8) == undefined_address, other_kind);
}

std::uint64_t linked_object(Bytes message)
{
  require(message.number(1) == 1, other_kind);
  const std::uint64_t flags = message.number(1);
  enum : std::uint64_t
  {
    has_type = 8,
    hard     = 0
  };
  const std::uint64_t type = (flags & has_type) != 0 ? message.number(1) : hard;
  message.take((flags & 4) != 0 ? 8 : 0);  // creation order
  message.take((flags & 16) != 0 ? 1 : 0); // character set
  message.take(message.number(std::size_t(1) << (flags & 3)));
  if (type == hard)
    return message.number(8);
  message.take(message.number(2));
  return undefined_address;
}

ChunkTree chunk_tree(Bytes layout)
{
  constexpr std::uint64_t chunked = 2;
  const std::uint64_t version     = layout.number(1);
  const std::uint64_t kind        = layout.number(1);
  ChunkTree tree;
  if (kind != chunked)
    return tree;
  require(version == 3, other_kind);
  const std::uint64_t rank = layout.number(1); // with one for the bytes of a value
  require(rank >= 1 && rank <= 33, "has damaged extents");
  tree.address   = layout.number(8);
  tree.key_bytes = 8 + 8 * rank;
  return tree;
}
} // namespace hdf5
} // namespace mesoslip
