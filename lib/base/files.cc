#include "base/files.h"

#include "base/errors.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace mesoslip
{
std::string system_message()
{
  return std::strerror(errno);
}

std::string read_file(const std::string &path)
{
  namespace fs = std::filesystem;
  std::error_code code;
  const auto status = fs::status(path, code);
  if (!fs::exists(status))
    throw UserError(path + ": there is no such file");
  if (fs::is_directory(status))
    throw UserError(path + " is a folder, but a file is needed");

  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)),
                   std::istreambuf_iterator<char>());
  if (!in)
    throw UserError(path + ": cannot be read (" + system_message() + ")");
  return text;
}

void write_file(const std::string &path, const std::string &text)
{
  const std::string part = path + ".part";
  errno                  = 0;
  {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out.write(text.data(), static_cast<std::streamsize>(text.size()));
    out.close();
    if (!out)
      {
        const std::string reason = system_message();
        std::error_code ignored;
        std::filesystem::remove(part, ignored);
        throw UserError(part + ": cannot be written (" + reason + ")");
      }
  }
  std::error_code code;
  std::filesystem::rename(part, path, code);
  if (code)
    throw UserError(path + ": cannot be replaced (" + code.message() + ")");
}
} // namespace mesoslip
