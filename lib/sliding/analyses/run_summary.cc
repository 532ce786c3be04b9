#include "sliding/analyses/run_summary.h"

#include "base/errors.h"
#include "base/files.h"

#include <filesystem>

namespace mesoslip
{
RunSummary::RunSummary(const std::string &key, const std::string &folder)
  : key(key)
  , path(folder)
{
  std::error_code ignored;
  // A file in the folder stands for the folder, as elsewhere.
  if (std::filesystem::is_regular_file(path, ignored))
    path = std::filesystem::path(path).parent_path().string();
  if (!std::filesystem::is_directory(path, ignored))
    throw UserError(key + ": there is no folder " + path +
                    "; run contact_dynamics first");
  const std::string name = file("summary.json");
  if (!std::filesystem::is_regular_file(name, ignored))
    throw UserError(
      key + ": " + path +
      " holds no summary.json, so the run has not finished; run contact_dynamics");
  json = nlohmann::json::parse(read_file(name), nullptr, false);
  if (!json.is_object())
    throw UserError(key + ": " + name + " is no JSON object; run contact_dynamics again");
}

std::string RunSummary::file(const std::string &name) const
{
  return (std::filesystem::path(path) / name).string();
}

std::string RunSummary::text(const std::string &name) const
{
  const auto found = json.find(name);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}

void RunSummary::require_analysis(const std::string &analysis) const
{
  const std::string found = text("analysis");
  if (found != analysis)
    throw UserError(
      key + ": " + path + " holds " +
      (found.empty() ? "no contact_dynamics run" : "the analysis '" + found + "'") +
      ", but '" + analysis + "' is needed");
}

std::optional<double> RunSummary::find_number(const std::string &name) const
{
  const auto found = json.find(name);
  return found != json.end() && found->is_number()
           ? std::optional<double>(found->get<double>())
           : std::nullopt;
}

double RunSummary::number(const std::string &name, const std::string &missing) const
{
  const std::optional<double> value = find_number(name);
  if (!value)
    throw UserError(key + ": " + file("summary.json") + " has no number " + name + ": " +
                    missing);
  return *value;
}

std::map<std::string, double> RunSummary::numbers(const std::string &name) const
{
  std::map<std::string, double> values;
  if (json.contains(name) && json.at(name).is_object())
    for (const auto &[item, value] : json.at(name).items())
      if (value.is_number())
        values[item] = value.get<double>();
  return values;
}
} // namespace mesoslip
