#ifndef mesoslip_io_checksum_h
#define mesoslip_io_checksum_h

#include <cstddef>
#include <string>

namespace mesoslip
{
/** Bytes at the begin of a signed file that the line takes; a user block of HDF5. */
constexpr std::size_t signature_bytes = 512;

/** What the line at the begin of a file says of the bytes after it. */
enum class Signature
{
  missing, ///< there is none: the file is older, or of another program
  valid,   ///< they are those that were signed
  broken   ///< they have changed
};

/**
 * Writes "FORMAT xxh3-128 CHECKSUM" and a line feed into the first bytes of @p path,
 * which are free for it: the 128 bit XXH3 checksum of all bytes after signature_bytes, in
 * 32 hexadecimal digits. It tells accidents, no intent. @throws UserError if the file
 * cannot be read or written.
 */
void sign_file(const std::string &path, const std::string &format);

/** Puts @p line in the place of the checksum for the time being. @throws UserError. */
void write_first_line(const std::string &path, const std::string &line);

/** What write_first_line() or sign_file() wrote last; empty if none did. */
std::string first_line(const std::string &path);

/** Compares a file with its line. @throws UserError if it cannot be read. */
Signature check_signature(const std::string &path);
} // namespace mesoslip

#endif
