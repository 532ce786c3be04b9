#include "io/earlier_results.h"

#include "io/errors.h"
#include "io/files.h"

#include <fstream>

namespace mesoslip
{
namespace fs = std::filesystem;

namespace
{
constexpr char list_name[] = "earlier_results.txt";
} // namespace

bool is_result(const fs::directory_entry &entry)
{
  std::error_code ignored;
  const std::string kind = entry.path().extension().string();
  return entry.is_regular_file(ignored) &&
         (kind == ".h5" || kind == ".csv" || kind == ".xdmf");
}

EarlierResults::EarlierResults(const std::string &folder)
  : folder(folder)
{
  std::error_code ignored;
  for (const fs::directory_entry &entry : fs::directory_iterator(folder, ignored))
    if (is_result(entry))
      written[entry.path().filename().string()] = entry.last_write_time(ignored);
  write_list();
}

void EarlierResults::replaced()
{
  for (auto file = written.begin(); file != written.end();)
    {
      std::error_code code;
      const bool same =
        fs::last_write_time(fs::path(folder) / file->first, code) == file->second;
      file = same && !code ? std::next(file) : written.erase(file);
    }
  write_list();
}

void EarlierResults::adopted()
{
  written.clear();
  write_list();
}

void EarlierResults::write_list() const
{
  const std::string path = folder + "/" + list_name;
  if (written.empty())
    {
      std::error_code ignored;
      fs::remove(path, ignored);
      return;
    }
  std::string text = "# Not of the run that parameters.prm and log.txt belong to, which "
                     "has not ended, has failed or has no such results:\n";
  for (const auto &[name, time] : written)
    text += name + "\n";
  write_file(path, text);
}

void require_of_latest_run(const std::string &what, const std::string &path)
{
  const fs::path file = path;
  std::ifstream list(file.parent_path() / list_name);
  std::string line;
  while (std::getline(list, line))
    if (line == file.filename().string())
      throw UserError(
        what + path +
        " is older than the run whose parameters and log are beside it, which has not "
        "ended, has failed or has no such result; run it again, or remove " +
        list_name + " there to use the old file all the same");
}
} // namespace mesoslip
