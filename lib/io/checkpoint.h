#ifndef mesoslip_io_checkpoint_h
#define mesoslip_io_checkpoint_h

#include <cstdint>
#include <string>
#include <vector>

namespace mesoslip
{
/** What surrounds the state in a checkpoint, and must fit when it is read. */
struct CheckpointHeader
{
  /** What was saved: "contact_dynamics". At most 63 characters. */
  std::string kind;
  /** Version of the layout of the state. */
  std::uint32_t version = 1;
  std::uint32_t dim     = 2; ///< space dimension of the run
};

/**
 * Writes @p pieces, one after the other, to `<path>.part`, waits for the disk, then
 * renames: an interruption at any moment leaves the old or the new checkpoint.
 * @throws UserError if the disk is full or the folder not writable.
 */
void write_checkpoint(const std::string &path,
                      const CheckpointHeader &header,
                      const std::vector<std::string> &pieces);

/**
 * Returns the pieces as one. @throws UserError that says what is wrong: missing, not a
 * checkpoint, truncated, damaged (CRC), of another kind, version or dimension.
 */
std::string read_checkpoint(const std::string &path, const CheckpointHeader &expected);
} // namespace mesoslip

#endif
