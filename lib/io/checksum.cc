#include "io/checksum.h"

#include "io/errors.h"
#include "io/files.h"

#include <cerrno>
#include <fstream>
#include <sstream>
#include <vector>

// The library's functions, inlined: nothing has to be linked.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace mesoslip
{
namespace
{
constexpr char method[] = "xxh3-128";

std::string hex(const XXH128_hash_t &hash)
{
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, hash);
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : canonical.digest)
    {
      text += digits[byte >> 4];
      text += digits[byte & 0xf];
    }
  return text;
}

/** Of all that is left to be read. */
std::string checksum_of_rest(std::ifstream &in, const std::string &path)
{
  // A piece stays in the cache between the two who look at it.
  std::vector<char> piece(1 << 18);
  XXH3_state_t state;
  XXH3_128bits_reset(&state);
  errno = 0;
  do
    {
      in.read(piece.data(), static_cast<std::streamsize>(piece.size()));
      XXH3_128bits_update(&state, piece.data(), static_cast<std::size_t>(in.gcount()));
    }
  while (in);
  if (in.bad())
    throw UserError(path + ": cannot be read (" + system_message() + ")");
  return hex(XXH3_128bits_digest(&state));
}
} // namespace

void sign_file(const std::string &path, const std::string &format)
{
  std::ifstream in(path, std::ios::binary);
  in.seekg(signature_bytes);
  const std::string line =
    format + " " + method + " " + checksum_of_rest(in, path) + "\n";
  in.close();
  errno = 0;
  std::fstream out(path, std::ios::binary | std::ios::in | std::ios::out);
  out.write(line.data(), static_cast<std::streamsize>(line.size()));
  out.close();
  if (!out || line.size() > signature_bytes)
    throw UserError(path + ": cannot be written (" + system_message() + ")");
}

Signature check_signature(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  std::string head(signature_bytes, '\0');
  in.read(head.data(), signature_bytes);
  std::istringstream line(head.substr(0, head.find('\n')));
  std::string format, name, checksum;
  if (!in || head.find('\n') == std::string::npos ||
      !(line >> format >> name >> checksum) || name != method)
    return Signature::missing;
  return checksum_of_rest(in, path) == checksum ? Signature::valid : Signature::broken;
}
} // namespace mesoslip
