#include "io/checksum.h"

#include "base/errors.h"
#include "base/files.h"

#include <cerrno>
#include <cinttypes>
#include <cstdio>
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

/** The 32 digits of its canonical form. */
std::string hex(const XXH128_hash_t &hash)
{
  char text[33];
  std::snprintf(text, sizeof(text), "%016" PRIx64 "%016" PRIx64, hash.high64, hash.low64);
  return text;
}

/** Of all bytes after the line. */
std::string checksum_of_rest(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  in.seekg(signature_bytes);
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

void write_first_line(const std::string &path, const std::string &line)
{
  errno = 0;
  std::fstream out(path, std::ios::binary | std::ios::in | std::ios::out);
  out << line << '\n';
  out.close();
  if (!out || line.size() >= signature_bytes)
    throw UserError(path + ": cannot be written (" + system_message() + ")");
}

std::string first_line(const std::string &path)
{
  std::ifstream in(path, std::ios::binary);
  std::string head(signature_bytes, '\0');
  in.read(head.data(), signature_bytes);
  const std::size_t end = head.find('\n');
  return in && end != std::string::npos ? head.substr(0, end) : "";
}

void sign_file(const std::string &path, const std::string &format)
{
  write_first_line(path, format + " " + method + " " + checksum_of_rest(path));
}

Signature check_signature(const std::string &path)
{
  std::istringstream line(first_line(path));
  std::string format, name, checksum;
  if (!(line >> format >> name >> checksum) || name != method)
    return Signature::missing;
  return checksum_of_rest(path) == checksum ? Signature::valid : Signature::broken;
}
} // namespace mesoslip
