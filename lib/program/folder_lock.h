#ifndef mesoslip_program_folder_lock_h
#define mesoslip_program_folder_lock_h

#include <string>

namespace mesoslip
{
/**
 * Locks a folder for this process. The system releases the lock when the process ends in
 * any way, so a dead process leaves no lock behind.
 */
class FolderLock
{
public:
  /** @throws UserError if another running process locks @p folder (naming its id). */
  explicit FolderLock(const std::string &folder);
  ~FolderLock();
  FolderLock(const FolderLock &)            = delete;
  FolderLock &operator=(const FolderLock &) = delete;

private:
  std::string path;
  int descriptor = -1;
};

/** Whether a running process locks @p folder. */
bool is_locked(const std::string &folder);
} // namespace mesoslip

#endif
