#include "io/unfinished.h"

#include "io/errors.h"
#include "io/files.h"

#include <filesystem>
#include <fstream>
#include <set>

namespace mesoslip
{
namespace fs = std::filesystem;

void mark_unfinished(const std::string &folder)
{
  std::set<std::string> names; // sorted
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    {
      const std::string kind = entry.path().extension().string();
      if (entry.is_regular_file(ignored) &&
          (kind == ".h5" || kind == ".csv" || kind == ".xdmf"))
        names.insert(entry.path().filename().string());
    }
  if (names.empty())
    return unmark_unfinished(folder);
  std::string text =
    "# The run that parameters.prm and log.txt belong to has not ended, or has "
    "failed. Of an earlier run are:\n";
  for (const std::string &name : names)
    text += name + "\n";
  write_file(folder + "/" + unfinished_name, text);
}

void unmark_unfinished(const std::string &folder)
{
  std::error_code ignored;
  fs::remove(folder + "/" + unfinished_name, ignored);
}

void require_finished(const std::string &what, const std::string &path)
{
  const fs::path file = path;
  std::ifstream list(file.parent_path() / unfinished_name);
  std::string line;
  while (std::getline(list, line))
    if (line == file.filename().string())
      throw UserError(
        what + path +
        " is older than the run whose parameters and log are beside it, which "
        "has not ended or has failed; run it again, or remove " +
        unfinished_name + " there to use the old file all the same");
}
} // namespace mesoslip
