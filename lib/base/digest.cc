#include "base/digest.h"

#include "base/files.h"

#include <cinttypes>
#include <cstdio>
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

void Digest::add_number(std::uint64_t number)
{
  for (int i = 0; i < 8; ++i, number >>= 8)
    {
      const unsigned char byte = number & 0xff; // in this order on all machines
      add_bytes(&byte, 1);
    }
}

Digest &Digest::add(const std::string_view text)
{
  add_bytes(text.data(), text.size());
  add_number(text.size()); // separates this text from the next
  return *this;
}

Digest &Digest::add(const double number)
{
  std::uint64_t bits;
  std::memcpy(&bits, &number, sizeof(bits));
  add_number(bits);
  return *this;
}

Digest &Digest::add_file(const std::string &path)
{
  return add(read_file(path));
}

std::string Digest::hex() const
{
  char text[17];
  std::snprintf(text, sizeof(text), "%016" PRIx64, state);
  return text;
}
} // namespace mesoslip
