#include "base/errors.h"
#include "base/files.h"
#include "io/drafts.h"
#include "sliding/analyses/friction_homogenization.h"

#include <filesystem>

namespace mesoslip
{
namespace
{
/** Accepts a file in the folder in place of the folder. */
std::string folder_of(const std::string &given)
{
  std::error_code ignored;
  return std::filesystem::is_regular_file(given, ignored)
           ? std::filesystem::path(given).parent_path().string()
           : given;
}
} // namespace

RunSummary::RunSummary(const std::string &key, const std::string &given)
  : key(key)
  , folder(folder_of(given))
{
  std::error_code ignored;
  if (!std::filesystem::is_directory(folder, ignored))
    throw UserError(key + ": there is no folder " + folder +
                    "; run contact_dynamics first");
  const std::string name = file("summary.json");
  if (!std::filesystem::is_regular_file(name, ignored))
    throw UserError(
      key + ": " + folder +
      " holds no summary.json, so the run has not finished; run contact_dynamics");
  json = nlohmann::json::parse(read_file(name), nullptr, false);
  if (!json.is_object())
    throw UserError(key + ": " + name + " is no JSON object; run contact_dynamics again");
  if (json.value("draft", false) && !drafts_are_accepted())
    throw UserError(key + ": " + folder +
                    " holds drafts, in which nothing was computed; run contact_dynamics "
                    "without --try");
}

std::string RunSummary::file(const std::string &name) const
{
  return (std::filesystem::path(folder) / name).string();
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
      key + ": " + folder + " holds " +
      (found.empty() ? "no contact_dynamics run" : "the analysis '" + found + "'") +
      ", but '" + analysis + "' is needed");
}

std::optional<double> RunSummary::find_number(const std::string &name,
                                              const std::string &of) const
{
  const nlohmann::json object = of.empty() ? json : json.value(of, nlohmann::json());
  const auto found            = object.find(name);
  return found != object.end() && found->is_number()
           ? std::optional<double>(found->get<double>())
           : std::nullopt;
}
} // namespace mesoslip
