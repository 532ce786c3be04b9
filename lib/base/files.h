#ifndef mesoslip_base_files_h
#define mesoslip_base_files_h

#include <string>

namespace mesoslip
{
/** All bytes of a file. @throws UserError beginning with the path. */
std::string read_file(const std::string &path);

/** Replaces a file in one go: writes `<path>.part`, then renames. @throws UserError. */
void write_file(const std::string &path, const std::string &text);

/** "No such file or directory" for the current errno. */
std::string system_message();
} // namespace mesoslip

#endif
