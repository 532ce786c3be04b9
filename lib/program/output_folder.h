#ifndef mesoslip_program_output_folder_h
#define mesoslip_program_output_folder_h

#include <string>
#include <vector>

namespace mesoslip
{
class Keys;

/** A file or folder that a run reads, with the key that names it. */
struct InputPath
{
  std::string key;  ///< "Body/RVE file"
  std::string path; ///< absolute, never empty
};

/** The values of all keys of inputs (Keys::bind_input()) that are not empty. */
std::vector<InputPath> input_paths(const Keys &keys);

/** What a run computes. */
struct RunKind
{
  std::string program;  ///< "contact_dynamics"
  std::string analysis; ///< "modal"; empty where the program has one only

  /** "the analysis 'modal' of contact_dynamics". */
  std::string text() const;
};

/** @p program with the value of the key Analysis, if it is declared. */
RunKind kind_of_run(const std::string &program, const Keys &keys);

/**
 * Whether a run of @p kind may write to @p folder, which need not exist. @throws
 * UserError if the folder, by whatever name, is one of the @p inputs or holds one that
 * the run would replace or part from its log and parameters; and if it holds results of
 * another program or analysis.
 */
void check_output_folder(const std::string &folder,
                         const RunKind &kind,
                         const std::vector<InputPath> &inputs);
} // namespace mesoslip

#endif
