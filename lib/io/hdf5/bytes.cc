#include "io/hdf5/bytes.h"

#include "io/checksum.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>

namespace mesoslip
{
namespace hdf5
{
Bytes::Bytes(const unsigned char *begin, const std::size_t size)
  : begin(begin)
  , size(size)
{
}

Bytes::Bytes(const std::vector<unsigned char> &memory)
  : Bytes(memory.data(), memory.size())
{
}

Bytes Bytes::take(const std::size_t n)
{
  require(n <= size, "is longer than its place");
  const Bytes taken(begin, n);
  begin += n;
  size -= n;
  return taken;
}

std::uint64_t Bytes::number(const std::size_t n_bytes)
{
  const Bytes taken   = take(n_bytes);
  std::uint64_t value = 0;
  for (std::size_t k = n_bytes; k-- > 0;)
    value = value << 8 | taken.begin[k];
  return value;
}

void Bytes::signature(const char *expected)
{
  const std::size_t n = std::strlen(expected);
  require(std::memcmp(take(n).begin, expected, n) == 0,
          "is not where something else refers to it");
}

bool Bytes::has_zero() const
{
  return std::find(begin, begin + size, 0) != begin + size;
}

RawFile::RawFile(const std::string &path)
  : descriptor(open(path.c_str(), O_RDONLY | O_CLOEXEC))
{
  struct stat status = {};
  if (descriptor >= 0 && fstat(descriptor, &status) == 0)
    n_bytes = static_cast<std::uint64_t>(status.st_size);
  std::string first(superblock_signature.size(), '\0');
  const bool at_begin = pread(descriptor, first.data(), first.size(), 0) ==
                          static_cast<ssize_t>(first.size()) &&
                        first == superblock_signature;
  if (!at_begin && n_bytes >= signature_bytes)
    {
      start = signature_bytes;
      n_bytes -= start;
    }
}

RawFile::~RawFile()
{
  if (descriptor >= 0)
    close(descriptor);
}

void RawFile::require_inside(const std::uint64_t address, const std::uint64_t n) const
{
  require(n <= n_bytes && address <= n_bytes - n, "lies beyond the end");
}

std::vector<unsigned char> RawFile::read(const std::uint64_t address,
                                         const std::uint64_t n) const
{
  constexpr std::uint64_t often = 20, always_allowed = 1 << 20;
  require_inside(address, n);
  n_read += n;
  require(n_read <= often * n_bytes + always_allowed, "goes round in a circle");
  std::vector<unsigned char> bytes(n);
  require(pread(descriptor, bytes.data(), n, static_cast<off_t>(start + address)) ==
            static_cast<ssize_t>(n),
          "cannot be read");
  return bytes;
}
} // namespace hdf5
} // namespace mesoslip
