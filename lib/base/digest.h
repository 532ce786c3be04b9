#ifndef mesoslip_base_digest_h
#define mesoslip_base_digest_h

#include <cstdint>
#include <string>
#include <string_view>

namespace mesoslip
{
/**
 * 64-bit FNV-1a, the same on all machines. Tells inputs apart; no protection against
 * intent. Each add() separates: ("ab", "c") differs from ("a", "bc").
 */
class Digest
{
public:
  /** A text, with its length. */
  Digest &add(const std::string_view text);

  /** All bits count: -0 and 0 differ. */
  Digest &add(const double number);

  /** The content of a file, not its name. @throws UserError if it cannot be read. */
  Digest &add_file(const std::string &path);

  /** 16 hexadecimal digits. */
  std::string hex() const;

private:
  void add_bytes(const void *data, const std::size_t n);
  void add_number(std::uint64_t number);

  std::uint64_t state = 0xcbf29ce484222325u;
};
} // namespace mesoslip

#endif
