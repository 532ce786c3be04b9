#ifndef mesoslip_io_checkpoint_h
#define mesoslip_io_checkpoint_h

#include <string>

namespace mesoslip
{
/**
 * Writes @p state to `<path>.part`, waits for the disk, then renames: an interruption at
 * any moment leaves the old or the new checkpoint. @p kind describes the state and its
 * layout: "contact_dynamics, 2D, layout N".
 * @throws UserError if the disk is full or the folder is not writable.
 */
void write_checkpoint(const std::string &path,
                      const std::string &kind,
                      std::string state);

/**
 * Reads the state.
 * @throws UserError with the reason: missing, not a checkpoint, truncated, damaged
 * (CRC), or of another kind than @p kind.
 */
std::string read_checkpoint(const std::string &path, const std::string &kind);
} // namespace mesoslip

#endif
