#include "io/checkpoint.h"

#include "io/errors.h"
#include "io/files.h"

#include <boost/crc.hpp>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

namespace mesoslip
{
namespace
{
constexpr char magic[8] = {'m', 'e', 's', 'o', 'c', 'h', 'k', '1'};

/** What precedes the payload in the file; fixed width, native byte order. */
struct Preamble
{
  char magic[8]            = {};
  std::uint32_t byte_order = 0x01020304;
  std::uint32_t version    = 0;
  std::uint32_t dim        = 0;
  std::uint32_t crc        = 0;
  std::uint64_t size       = 0;
  char kind[64]            = {};
  char digest[64]          = {};
};
static_assert(sizeof(Preamble) == 160, "no padding in the file");

std::uint32_t crc_of(const char *data, const std::size_t n)
{
  boost::crc_32_type crc;
  crc.process_bytes(data, n);
  return crc.checksum();
}

void copy_text(const std::string &text, char (&target)[64])
{
  std::strncpy(target, text.c_str(), sizeof(target) - 1);
}

std::string text_of(const char (&source)[64])
{
  return std::string(source, strnlen(source, sizeof(source)));
}

bool write_all(const int descriptor, const char *data, std::size_t n)
{
  while (n > 0)
    {
      const ssize_t written = write(descriptor, data, n);
      if (written < 0 && errno == EINTR)
        continue;
      if (written <= 0)
        return false;
      data += written;
      n -= static_cast<std::size_t>(written);
    }
  return true;
}

/** So that the new name itself survives a power failure. */
void sync_folder_of(const std::string &path)
{
  const std::string folder = std::filesystem::absolute(path).parent_path().string();
  const int fd             = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (fd >= 0)
    {
      fsync(fd);
      close(fd);
    }
}
} // namespace

void write_checkpoint(const std::string &path,
                      const CheckpointHeader &header,
                      const std::string &payload)
{
  Preamble preamble;
  std::memcpy(preamble.magic, magic, sizeof(magic));
  preamble.version = header.version;
  preamble.dim     = header.dim;
  preamble.crc     = crc_of(payload.data(), payload.size());
  preamble.size    = payload.size();
  copy_text(header.kind, preamble.kind);
  copy_text(header.digest, preamble.digest);

  const std::string part = path + ".part";
  const int fd = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0)
    throw UserError(part + ": cannot be written (" + system_message() + ")");
  const bool written =
    write_all(fd, reinterpret_cast<const char *>(&preamble), sizeof(preamble)) &&
    write_all(fd, payload.data(), payload.size()) && fsync(fd) == 0;
  const std::string reason = written ? "" : system_message();
  const bool closed        = close(fd) == 0;
  if (!written || !closed)
    {
      unlink(part.c_str());
      throw UserError(part + ": the checkpoint cannot be written (" + reason +
                      "); the previous one, if any, is kept");
    }
  if (rename(part.c_str(), path.c_str()) != 0)
    throw UserError(path + ": the checkpoint cannot be replaced (" + system_message() +
                    ")");
  sync_folder_of(path);
}

std::string read_checkpoint(const std::string &path, const CheckpointHeader &expected)
{
  if (!std::filesystem::exists(path))
    throw UserError(path + ": there is no checkpoint to resume from");
  const std::string content = read_file(path);
  Preamble preamble;
  if (content.size() < sizeof(magic) || content.compare(0, 8, magic, 8) != 0)
    throw UserError(path + " is not a checkpoint of mesoslip");
  if (content.size() < sizeof(preamble))
    throw UserError(path + " is truncated: its header is not complete");
  std::memcpy(&preamble, content.data(), sizeof(preamble));

  if (preamble.byte_order != Preamble().byte_order)
    throw UserError(path + " was written on a machine with another byte order");
  if (text_of(preamble.kind) != expected.kind)
    throw UserError(path + " is a checkpoint of '" + text_of(preamble.kind) +
                    "', not of '" + expected.kind + "'");
  if (preamble.version != expected.version)
    throw UserError(path + " has layout version " + std::to_string(preamble.version) +
                    ", but this program reads version " +
                    std::to_string(expected.version));
  if (preamble.dim != expected.dim)
    throw UserError(path + " belongs to a " + std::to_string(preamble.dim) +
                    "D run, not to a " + std::to_string(expected.dim) + "D one");
  const std::size_t size = content.size() - sizeof(preamble);
  if (size != preamble.size)
    throw UserError(path + (size < preamble.size ? " is truncated: " : " is damaged: ") +
                    std::to_string(size) + " bytes of state instead of " +
                    std::to_string(preamble.size));
  if (crc_of(content.data() + sizeof(preamble), size) != preamble.crc)
    throw UserError(path + " is damaged: its checksum does not fit");
  if (text_of(preamble.digest) != expected.digest)
    throw UserError(path +
                    " belongs to a run with other parameters or input files; resume "
                    "with those, or start again without --resume");
  return content.substr(sizeof(preamble));
}
} // namespace mesoslip
