#include "io/digest.h"

#include "io/files.h"

#include <cstring>

namespace mesoslip
{
void Digest::add_bytes(const void *data, const std::size_t n)
{
  const unsigned char *bytes = static_cast<const unsigned char *>(data);
  for (std::size_t i = 0; i < n; ++i)
    {
      state ^= bytes[i];
      state *= 0x100000001b3u;
    }
}

Digest &Digest::add(const std::string_view text)
{
  add_bytes(text.data(), text.size());
  // The length separates this text from the next.
  std::uint64_t length = text.size();
  for (int i = 0; i < 8; ++i, length >>= 8)
    {
      const unsigned char byte = length & 0xff;
      add_bytes(&byte, 1);
    }
  return *this;
}

Digest &Digest::add(const double number)
{
  std::uint64_t bits;
  std::memcpy(&bits, &number, sizeof(bits));
  for (int i = 0; i < 8; ++i, bits >>= 8)
    {
      const unsigned char byte = bits & 0xff;
      add_bytes(&byte, 1);
    }
  return *this;
}

Digest &Digest::add_file(const std::string &path)
{
  return add(read_file(path));
}

std::string Digest::hex() const
{
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(16, '0');
  for (int i = 0; i < 16; ++i)
    text[15 - i] = digits[(state >> (4 * i)) & 0xf];
  return text;
}
} // namespace mesoslip
