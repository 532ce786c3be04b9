#ifndef mesoslip_program_lock_h
#define mesoslip_program_lock_h

#include <string>

namespace mesoslip
{
/**
 * Holds a folder for this process. The system releases it when the process ends in
 * whatever way, so a lock left by a dead process is no obstacle.
 */
class FolderLock
{
public:
  /** @throws UserError when another running process holds @p folder (naming its id). */
  explicit FolderLock(const std::string &folder);
  ~FolderLock();
  FolderLock(const FolderLock &)            = delete;
  FolderLock &operator=(const FolderLock &) = delete;

private:
  std::string path;
  int descriptor = -1;
};
} // namespace mesoslip

#endif
