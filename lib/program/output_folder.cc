#include "program/output_folder.h"

#include "base/errors.h"
#include "base/files.h"
#include "parameters/keys.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <sstream>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** What every run replaces when it starts. */
constexpr std::array<const char *, 4> papers = {
  {"summary.json", "log.txt", "parameters.prm", "original.prm"}};

bool is_result(const fs::directory_entry &entry)
{
  std::error_code ignored;
  const std::string kind = entry.path().extension().string();
  return entry.is_regular_file(ignored) &&
         (kind == ".h5" || kind == ".csv" || kind == ".xdmf");
}

bool is_replaced(const fs::directory_entry &entry)
{
  const std::string name = entry.path().filename().string();
  return is_result(entry) ||
         std::find(papers.begin(), papers.end(), name) != papers.end();
}

/** Links and ".." do not matter; false if one of the two does not exist. */
bool are_the_same(const fs::path &one, const fs::path &other)
{
  std::error_code ignored;
  return fs::equivalent(one, other, ignored);
}

void check_input(const std::string &folder, const InputPath &input)
{
  const std::string remedy =
    ", where this run would replace log, parameters and summary; choose another folder "
    "with --output";
  if (are_the_same(input.path, folder))
    throw UserError(input.key + ": " + input.path + " is the output folder" + remedy);
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    if (is_replaced(entry) && are_the_same(entry.path(), input.path))
      throw UserError(input.key + ": " + input.path + " lies in the output folder " +
                      folder + remedy);
}

/** "# contact_dynamics 0.1.0: ..." and "set Analysis = modal" of the parameters.prm that a
 *  run writes when it begins. */
std::optional<RunKind> kind_in_parameters(const std::string &path)
{
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    return std::nullopt;
  std::istringstream text(read_file(path));
  RunKind kind;
  std::string line, hash;
  const std::string analysis = "set Analysis = ";
  std::getline(text, line);
  std::istringstream(line) >> hash >> kind.program;
  while (kind.analysis.empty() && std::getline(text, line))
    if (line.compare(0, analysis.size(), analysis) == 0)
      kind.analysis = line.substr(analysis.size());
  return kind;
}

/** What the results in a folder are of; nothing if it holds none. */
std::optional<RunKind> kind_of_results(const std::string &folder)
{
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    if (is_result(entry) || entry.path().extension() == ".checkpoint" ||
        entry.path().filename() == "summary.json")
      return kind_in_parameters(folder + "/parameters.prm");
  return std::nullopt;
}
} // namespace

std::string RunKind::text() const
{
  return analysis.empty() ? program : "the analysis '" + analysis + "' of " + program;
}

std::vector<InputPath> input_paths(const Keys &keys)
{
  std::vector<InputPath> inputs;
  for (const Key &key : keys.all())
    if (key.is_input && !key.value.empty())
      inputs.push_back({key.path(), key.value});
  return inputs;
}

RunKind kind_of_run(const std::string &program, const Keys &keys)
{
  return {program, keys.has("Analysis") ? keys.value("Analysis") : ""};
}

void check_output_folder(const std::string &folder,
                         const RunKind &kind,
                         const std::vector<InputPath> &inputs)
{
  for (const InputPath &input : inputs)
    check_input(folder, input);
  const auto found = kind_of_results(folder);
  if (found && !found->program.empty() &&
      (found->program != kind.program || found->analysis != kind.analysis))
    throw UserError("the output folder " + folder + " holds results of " + found->text() +
                    ", which those of " + kind.text() +
                    " would replace; choose another folder with --output, or remove "
                    "that one");
}
} // namespace mesoslip
