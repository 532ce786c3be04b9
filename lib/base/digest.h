#ifndef mesoslip_base_digest_h
#define mesoslip_base_digest_h

#include "base/files.h"

#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace mesoslip
{
/**
 * 64-bit FNV-1a, the same on all machines. Tells inputs apart; no protection against
 * intent. Each add() separates: ("ab", "c") differs from ("a", "bc").
 */
class Digest
{
public:
  /** Adds a text and its length. */
  Digest &add(const std::string_view text)
  {
    add_bytes(text.data(), text.size());
    add_number(text.size()); // separates this text from the next
    return *this;
  }

  /** Adds the bits of a number: -0 and 0 differ. */
  Digest &add(const double number)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof(bits));
    add_number(bits);
    return *this;
  }

  /** The content of a file, not its name. @throws UserError if it cannot be read. */
  Digest &add_file(const std::string &path)
  {
    require_readable_file("", path);
    std::ifstream in(path, std::ios::binary);
    std::uint64_t n = 0;
    std::vector<char> piece(std::size_t{1} << 20U); // in pieces: may be large
    while (in.read(piece.data(), static_cast<std::streamsize>(piece.size())),
           in.gcount() > 0)
      {
        add_bytes(piece.data(), static_cast<std::size_t>(in.gcount()));
        n += static_cast<std::uint64_t>(in.gcount());
      }
    add_number(n);
    return *this;
  }

  /** The digest as 16 hexadecimal digits. */
  std::string hex() const
  {
    char text[17];
    std::snprintf(text, sizeof(text), "%016" PRIx64, state);
    return text;
  }

private:
  void add_bytes(const void *data, const std::size_t n)
  {
    const unsigned char *bytes = static_cast<const unsigned char *>(data);
    for (std::size_t i = 0; i < n; ++i)
      {
        state ^= bytes[i];
        state *= 0x100000001b3u;
      }
  }

  void add_number(std::uint64_t number)
  {
    for (int i = 0; i < 8; ++i, number >>= 8)
      {
        const unsigned char byte = number & 0xff; // the same byte order on all machines
        add_bytes(&byte, 1);
      }
  }

  std::uint64_t state = 0xcbf29ce484222325u;
};
} // namespace mesoslip

#endif
