#ifndef mesoslip_program_output_folder_h
#define mesoslip_program_output_folder_h

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/**
 * Checks that a run of @p program with the parameters @p keys may write to @p folder,
 * which need not exist.
 * @throws UserError if the folder, by whatever name, is an input (Keys::bind_input()) or
 * contains an input that the run would replace or separate from its log and parameters;
 * and if it contains results of another program or, by the key Analysis, of another
 * analysis.
 */
void check_output_folder(const std::string &folder,
                         const std::string &program,
                         const Keys &keys);

/** Disk space or memory that a run needs. */
struct ResourceNeed
{
  double bytes = 0.; ///< in addition to current use
  /** The keys that determine it, as advice: "reduce Grid/Cells". */
  std::string remedy;
};

/** "1.5 GB": two or three digits with a unit of powers of 1000. */
std::string bytes_text(const double bytes);

/** Memory of this machine (bytes), or the value of the environment variable
 * MESOSLIP_MEMORY, for users with a share of it; 0 if unknown.
 * @throws UserError */
double memory_of_machine();

/** @throws UserError if the machine has less memory. */
void require_memory(const ResourceNeed &need);

/** "about 90 x 45 cells would fit": for a grid with the proportions of @p cells, which
 * needs @p bytes. */
std::string cells_that_fit(const std::vector<unsigned int> &cells, const double bytes);

/**
 * Checks that @p folder exists or can be created, that it can be written to, and that its
 * disk has room. Creates nothing. @throws UserError
 */
void require_disk(const std::string &folder, const ResourceNeed &need);
} // namespace mesoslip

#endif
