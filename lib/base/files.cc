#include "base/files.h"

#include "base/errors.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace mesoslip
{
std::string system_message()
{
  return std::strerror(errno);
}

void require_readable_file(const std::string &what,
                           const std::string &path,
                           const std::string &hint)
{
  namespace fs            = std::filesystem;
  const std::string after = hint.empty() ? "" : "; " + hint;
  if (path.empty())
    throw UserError(what + "no file is named" + after);
  std::error_code code;
  const auto status = fs::status(path, code);
  if (!fs::exists(status))
    throw UserError(what + "there is no file " + path + after);
  if (fs::is_directory(status))
    throw UserError(what + path + " is a folder, but a file is needed" + after);
  errno = 0;
  if (!std::ifstream(path, std::ios::binary))
    throw UserError(what + path + " cannot be read (" + system_message() + ")" + after);
}

std::string read_file(const std::string &path)
{
  require_readable_file("", path);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)),
                   std::istreambuf_iterator<char>());
  if (!in)
    throw UserError(path + ": cannot be read (" + system_message() + ")");
  return text;
}

namespace
{
/** Waits until a file, or the names in a folder, are on the disk; false if that fails. */
bool sync_to_disk(const std::string &path)
{
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done      = descriptor >= 0 && fsync(descriptor) == 0;
  if (descriptor >= 0)
    close(descriptor);
  return done;
}
} // namespace

void write_file(const std::string &path,
                const std::vector<std::string> &pieces,
                const bool durable)
{
  const std::string part = path + ".part";
  errno                  = 0;
  std::ofstream out(part, std::ios::binary | std::ios::trunc);
  for (const std::string &piece : pieces)
    out.write(piece.data(), static_cast<std::streamsize>(piece.size()));
  out.close();
  std::error_code code;
  if (!out || (durable && !sync_to_disk(part)))
    {
      const std::string reason = system_message();
      std::filesystem::remove(part, code);
      throw UserError(part + ": cannot be written (" + reason + ")");
    }
  std::filesystem::rename(part, path, code);
  if (code)
    throw UserError(path + ": cannot be replaced (" + code.message() + ")");
  if (durable) // so that the new name itself survives a power failure
    sync_to_disk(std::filesystem::absolute(path).parent_path().string());
}

void write_file(const std::string &path, const std::string &text)
{
  write_file(path, std::vector<std::string>{text});
}
} // namespace mesoslip
