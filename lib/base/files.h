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

/** @p path, or the file @p name in it where it is a folder. */
std::string file_or_in_folder(const std::string &path, const std::string &name);

/** All bytes of a file. @throws UserError beginning with the path. */
std::string read_file(const std::string &path);

/**
 * Replaces a file in one go: writes `<path>.part`, then renames. With @p durable it waits
 * until bytes and name are on the disk, so that a crash of the machine at any moment
 * leaves the old or the new file. @throws UserError
 */
void write_file(const std::string &path,
                const std::vector<std::string> &pieces,
                const bool durable = false);

/** Replaces a file by @p text, not durably. @throws UserError */
void write_file(const std::string &path, const std::string &text);

/** "No such file or directory" for the current errno. */
std::string system_message();
} // namespace mesoslip

#endif
