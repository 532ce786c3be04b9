#ifndef mesoslip_base_files_h
#define mesoslip_base_files_h

#include <string>
#include <vector>

namespace mesoslip
{
/** Throws a UserError beginning with @p what unless @p path is a readable file. */
void require_readable_file(const std::string &what,
                           const std::string &path,
                           const std::string &hint = "");

/** Returns @p path, or the file @p name in it if @p path is a folder. */
std::string file_or_in_folder(const std::string &path, const std::string &name);

/** All bytes of a file. @throws UserError beginning with the path. */
std::string read_file(const std::string &path);

/**
 * Replaces a file atomically: writes `<path>.part`, then renames it. With @p durable it
 * waits until bytes and name are on the disk: after a crash of the machine there is
 * either the old or the new file. @throws UserError
 */
void write_file(const std::string &path,
                const std::vector<std::string> &pieces,
                const bool durable = false);

/** Replaces a file by @p text, not durably. @throws UserError */
void write_file(const std::string &path, const std::string &text);

/** Text of errno, such as "No such file or directory". */
std::string system_message();
} // namespace mesoslip

#endif
