#include "io/checkpoint.h"

#include "base/errors.h"
#include "base/files.h"

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
};
static_assert(sizeof(Preamble) == 96, "no padding in the file");

std::string kind_of(const Preamble &preamble)
{
  return std::string(preamble.kind, strnlen(preamble.kind, sizeof(preamble.kind)));
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
                      const std::vector<std::string> &pieces)
{
  Preamble preamble;
  std::memcpy(preamble.magic, magic, sizeof(magic));
  preamble.version = header.version;
  preamble.dim     = header.dim;
  boost::crc_32_type crc;
  for (const std::string &piece : pieces)
    {
      crc.process_bytes(piece.data(), piece.size());
      preamble.size += piece.size();
    }
  preamble.crc = crc.checksum();
  std::strncpy(preamble.kind, header.kind.c_str(), sizeof(preamble.kind) - 1);

  const std::string part = path + ".part";
  const int fd = open(part.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (fd < 0)
    throw UserError(part + ": cannot be written (" + system_message() + ")");
  bool written =
    write_all(fd, reinterpret_cast<const char *>(&preamble), sizeof(preamble));
  for (const std::string &piece : pieces)
    written = written && write_all(fd, piece.data(), piece.size());
  written                  = written && fsync(fd) == 0;
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
  std::string content = read_file(path);
  Preamble preamble;
  if (content.size() < sizeof(magic) || content.compare(0, 8, magic, 8) != 0)
    throw UserError(path + " is not a checkpoint of mesoslip");
  if (content.size() < sizeof(preamble))
    throw UserError(path + " is truncated: its header is not complete");
  std::memcpy(&preamble, content.data(), sizeof(preamble));

  if (preamble.byte_order != Preamble().byte_order)
    throw UserError(path + " was written on a machine with another byte order");
  if (kind_of(preamble) != expected.kind)
    throw UserError(path + " is a checkpoint of '" + kind_of(preamble) + "', not of '" +
                    expected.kind + "'");
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
  boost::crc_32_type crc;
  crc.process_bytes(content.data() + sizeof(preamble), size);
  if (crc.checksum() != preamble.crc)
    throw UserError(path + " is damaged: its checksum does not fit");
  return content.erase(0, sizeof(preamble));
}
} // namespace mesoslip
