#ifndef mesoslip_io_checkpoint_h
#define mesoslip_io_checkpoint_h

#include <cstdint>
#include <string>

namespace mesoslip
{
/** What surrounds the state in a checkpoint, and must fit when it is read. */
struct CheckpointHeader
{
  /** What was saved: "contact_dynamics". At most 63 characters. */
  std::string kind;
  /** Of the payload's layout. */
  std::uint32_t version = 1;
  std::uint32_t dim     = 2;
  /** Of the inputs that determine the run, Digest::hex(). At most 63 characters. */
  std::string digest;
};

/**
 * Writes @p payload to `<path>.part`, waits for the disk, then renames: an interruption
 * at any moment leaves the old or the new checkpoint. Several ranks write a file each.
 * @throws UserError if the disk is full or the folder not writable.
 */
void write_checkpoint(const std::string &path,
                      const CheckpointHeader &header,
                      const std::string &payload);

/**
 * Returns the payload. @throws UserError that says what is wrong: missing, not a
 * checkpoint, truncated, damaged (CRC), of another kind, version, dimension, or of a run
 * with other parameters.
 */
std::string read_checkpoint(const std::string &path, const CheckpointHeader &expected);
} // namespace mesoslip

#endif
