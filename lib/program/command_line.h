#ifndef mesoslip_program_command_line_h
#define mesoslip_program_command_line_h

#include <string>
#include <vector>

namespace mesoslip
{
/** The parsed command line. */
struct CommandLine
{
  bool help             = false; ///< --help
  bool version          = false; ///< --version
  bool print_parameters = false; ///< --print-parameters
  bool validate         = false; ///< --validate: check, but do not run
  bool resume           = false; ///< --resume: go on from the checkpoint
  bool trial            = false; ///< --try: run on drafts, too, and make drafts
  bool quiet            = false; ///< --quiet
  bool profile          = false; ///< --profile: print the timings
  bool ignore_unused    = false; ///< --ignore-unused: keys without effect are no error
  bool serve            = false; ///< --serve: carry out command lines that come in
  bool summary_only     = false; ///< --summary-only: no file but log and summary
  bool nested           = false; ///< part of another run, which reports errors
  std::string output;            ///< folder after --output; empty: folder of the .prm
  std::string prm_file;          ///< path as typed
  std::string draft;             ///< folder after --draft; empty: no draft
  std::vector<std::string> assignments; ///< 'Section/Key=value' after each --set

  /** @p draft: content of a --draft; empty: no such option.
   * @throws UserError for unknown options, several files, or a missing file. */
  static CommandLine parse(int argc, const char *const *argv, const std::string &draft);

  /** Text of --help. */
  static std::string help_text(const std::string &program,
                               const std::string &description,
                               const std::string &draft);
};
} // namespace mesoslip

#endif
