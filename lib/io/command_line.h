#ifndef mesoslip_io_command_line_h
#define mesoslip_io_command_line_h

#include <string>
#include <vector>

namespace mesoslip
{
/** The words after the program's name, understood. */
struct CommandLine
{
  bool help             = false;
  bool version          = false;
  bool print_parameters = false;
  bool validate         = false;
  bool resume           = false;
  bool quiet            = false;
  bool profile          = false;
  std::string output;
  std::string prm_file;
  std::vector<std::string> assignments;

  /** @throws UserError for unknown options, several files, or none where one is needed.
   */
  static CommandLine parse(int argc, char **argv);

  /** What --help prints. */
  static std::string help_text(const std::string &program,
                               const std::string &description);
};
} // namespace mesoslip

#endif
