#ifndef mesoslip_program_resources_h
#define mesoslip_program_resources_h

#include <string>

namespace mesoslip
{
/** What a run is going to take of a disk or of the memory. */
struct ResourceNeed
{
  double bytes = 0.; ///< in addition to what is taken now
  /** The keys that decide it and how: "reduce Grid/Cells". */
  std::string remedy;
};

/** "1.5 GB": two or three digits with a unit of powers of 1000. */
std::string bytes_text(const double bytes);

/** @throws UserError when the machine has less memory. */
void require_memory(const ResourceNeed &need);

/**
 * Checks that @p folder exists or can be created, that it can be written to, and that its
 * disk has room. Creates nothing. @throws UserError
 */
void require_disk(const std::string &folder, const ResourceNeed &need);
} // namespace mesoslip

#endif
