#ifndef mesoslip_program_output_folder_h
#define mesoslip_program_output_folder_h

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/**
 * Whether a run of @p program with the parameters @p keys may write to @p folder, which need
 * not exist. @throws UserError if the folder, by whatever name, is one of the inputs
 * (Keys::bind_input()) or holds one that the run would replace or part from its log and
 * parameters; and if it holds results of another program or, by the key Analysis, of another
 * analysis.
 */
void check_output_folder(const std::string &folder,
                         const std::string &program,
                         const Keys &keys);

/** What a run is going to take of a disk or of the memory. */
struct ResourceNeed
{
  double bytes = 0.; ///< in addition to what is taken now
  /** The keys that decide it and how: "reduce Grid/Cells". */
  std::string remedy;
};

/** "1.5 GB": two or three digits with a unit of powers of 1000. */
std::string bytes_text(const double bytes);

/** Bytes of memory of this machine, or as many as the environment variable MESOSLIP_MEMORY
 * says, for who may use a part; 0 where it does not tell. @throws UserError */
double memory_of_machine();

/** @throws UserError when the machine has less memory. */
void require_memory(const ResourceNeed &need);

/** "about 90 x 45 cells would fit": of the shape of a grid of @p cells that needs @p bytes. */
std::string cells_that_fit(const std::vector<unsigned int> &cells, const double bytes);

/**
 * Checks that @p folder exists or can be created, that it can be written to, and that its
 * disk has room. Creates nothing. @throws UserError
 */
void require_disk(const std::string &folder, const ResourceNeed &need);

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
