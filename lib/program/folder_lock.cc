#include "program/folder_lock.h"

#include "base/errors.h"
#include "base/files.h"

#include <cerrno>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mesoslip
{
namespace
{
std::string owner(const int descriptor)
{
  char text[32]   = {};
  const ssize_t n = pread(descriptor, text, sizeof(text) - 1, 0);
  return n > 0 ? " (process " + std::string(text, static_cast<std::size_t>(n)) + ")" : "";
}

/** Whether the file behind @p descriptor is still named @p path. */
bool still_named(const int descriptor, const std::string &path)
{
  struct stat mine, named;
  return fstat(descriptor, &mine) == 0 && stat(path.c_str(), &named) == 0 &&
         mine.st_ino == named.st_ino && mine.st_dev == named.st_dev;
}
} // namespace

FolderLock::FolderLock(const std::string &folder)
  : path(folder + "/.lock")
{
  // The holder removes the file before it releases the lock: try again then.
  while (true)
    {
      descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
      if (descriptor < 0)
        throw UserError(folder + ": cannot be written to (" + system_message() + ")");
      if (flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        {
          const std::string who = owner(descriptor);
          close(descriptor);
          throw UserError(folder + " is in use by a run that has not ended" + who +
                          "; give another folder with --output or wait");
        }
      if (still_named(descriptor, path))
        break;
      close(descriptor);
    }
  const std::string id = std::to_string(getpid());
  if (ftruncate(descriptor, 0) != 0 ||
      pwrite(descriptor, id.data(), id.size(), 0) != static_cast<ssize_t>(id.size()))
    {
      const std::string reason = system_message();
      unlink(path.c_str());
      close(descriptor);
      throw UserError(path + ": cannot be written (" + reason + ")");
    }
}

FolderLock::~FolderLock()
{
  unlink(path.c_str());
  close(descriptor);
}

bool is_locked(const std::string &folder)
{
  const int descriptor = open((folder + "/.lock").c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0)
    return false;
  const bool locked = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  close(descriptor);
  return locked;
}
} // namespace mesoslip
