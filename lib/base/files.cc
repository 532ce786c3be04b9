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

namespace
{
/** Whether the program named in the .prm file @p maker writes a file called @p name. */
bool makes(const std::string &maker, const std::string &name)
{
  const auto is_of = [&](const char *program) {
    return maker.find(program) != std::string::npos;
  };
  return name == "rve.h5" || name == "loads.h5" ? is_of("rve_homogenization")
         : name == "localization.h5"            ? is_of("stress_localization")
                                                : is_of("contact_dynamics");
}

/**
 * Hint if @p path is a result of another file of a chain (NAME/rve.h5 beside NAME.prm, or
 * the folder NAME of a run): the result lies in the results folder of the chain.
 * Otherwise empty.
 */
std::string hint_in_chain(const std::string &path)
{
  namespace fs = std::filesystem;
  std::error_code ignored;
  for (const fs::path &folder : {fs::path(path).parent_path(), fs::path(path)})
    if (const fs::path maker = folder.string() + ".prm";
        folder.has_filename() && fs::is_regular_file(maker, ignored) &&
        (folder == path || fs::path(path).extension() == ".h5") &&
        makes(maker.filename().string(), fs::path(path).filename().string()))
      {
        const std::string chain =
          maker.has_parent_path() ? maker.parent_path().string() : ".";
        return "; " + maker.filename().string() +
               " makes it, in the results of a chain: './run.sh --validate " + chain +
               "' checks all its files, './run.sh " + chain +
               "' runs copies of them, which find what the others have made";
      }
  return "";
}
} // namespace

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
    {
      const std::string in_chain = hint_in_chain(path);
      throw UserError(what + "there is no file " + path +
                      (in_chain.empty() ? after : in_chain));
    }
  if (fs::is_directory(status))
    throw UserError(what + path + " is a folder, but a file is needed" + after);
  if (!fs::is_regular_file(status)) // opening a pipe would wait for its writer
    throw UserError(what + path +
                    " is a pipe or a device, but a file is needed; save it as one");
  errno = 0;
  if (!std::ifstream(path, std::ios::binary))
    throw UserError(what + path + " cannot be read (" + system_message() + ")" + after);
}

std::string file_or_in_folder(const std::string &path, const std::string &name)
{
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored)
           ? (std::filesystem::path(path) / name).string()
           : path;
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
