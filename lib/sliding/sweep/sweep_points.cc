#include "sliding/sweep/sweep_points.h"

#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "base/version.h"
#include "parameters/keys.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** File in the folder of a point that has ended. */
constexpr char mark[] = "point.json";

/** Names in the summary that describe the run or the body instead of results of the
 * point. */
const std::set<std::string> not_of_the_point = {
  "cell_updates_per_second", "cells",   "dim",   "dofs",    "draft",  "kernel",
  "peak_memory_bytes",       "program", "ranks", "seconds", "version"};

/** Takes numbers and texts of @p node; names of members are joined with a dot. */
void take(const nlohmann::json &node, const std::string &name, SweepResult &result)
{
  if (node.is_number())
    result.numbers[name] = node.get<double>();
  else if (node.is_boolean())
    result.numbers[name] = node.get<bool>() ? 1. : 0.;
  else if (node.is_string())
    result.texts[name] = node.get<std::string>();
  else if (node.is_object())
    for (const auto &[key, child] : node.items())
      take(child, name + "." + key, result);
}

/** Takes all single numbers and texts of summary.json in @p folder, with @p prefix before
 * their names. */
void take_summary(const std::string &folder,
                  const std::string &prefix,
                  SweepResult &result)
{
  const auto summary =
    nlohmann::json::parse(read_file(folder + "/summary.json"), nullptr, false);
  if (!summary.is_object())
    throw UserError(folder +
                    "/summary.json is no JSON object; remove the folder, so that "
                    "the point is computed again");
  for (const auto &[name, node] : summary.items())
    if (not_of_the_point.count(name) == 0)
      take(node, prefix + name, result);
  result.numbers[prefix + "warnings"] =
    static_cast<double>(summary.value("warnings", nlohmann::json::array()).size());
}

/** Adds the content of the files that @p keys name. */
void add_inputs(const Keys &keys, Digest &digest)
{
  for (const Key &key : keys.all())
    for (const std::string &input : key.inputs())
      {
        std::error_code ignored;
        const std::string file = file_or_in_folder(input, "contact_dynamics.end");
        if (fs::is_regular_file(file, ignored))
          digest.add_file(file);
      }
}

/** Content written by mark_point(); null: none. */
nlohmann::json marked(const std::string &folder)
{
  std::error_code ignored;
  return fs::is_regular_file(folder + "/" + mark, ignored)
           ? nlohmann::json::parse(read_file(folder + "/" + mark), nullptr, false)
           : nlohmann::json();
}

/** Adds the result of a marked run in @p folder to @p result. */
void add_run(const std::string &folder, const std::string &prefix, SweepResult &result)
{
  const nlohmann::json json = marked(folder);
  const std::string message =
    json.is_object() ? json.value("message", std::string()) : "it was not computed";
  result.status =
    std::max(result.status, message.empty() ? SweepStatus::done : SweepStatus::failed);
  if (message.empty())
    return take_summary(folder, prefix, result);
  result.message += (result.message.empty() ? "" : " ") + message;
}

/** Point @p k after the points on which it depends, in order of computation. */
std::vector<std::size_t> chain_to(const SweepParameters &parameters, const std::size_t k)
{
  std::vector<std::size_t> chain = {k};
  while (const auto before = parameters.point_before(chain.back()))
    chain.push_back(*before);
  std::reverse(chain.begin(), chain.end());
  return chain;
}
} // namespace

PointFolders::PointFolders(const SweepParameters &given, const Keys &keys)
  : parameters(given)
{
  std::vector<std::string> skip = {"Output folder", "Checkpoints/", "Sweep/"};
  for (const SweepAxis &axis : parameters.axes)
    for (const SweptKey &key : axis.keys)
      skip.push_back(key.path);
  common.add(version).add(canonical_parameters(keys, skip));
  add_inputs(keys, common);
}

Digest PointFolders::of_point(const SweepPoint &point) const
{
  Digest digest = common;
  for (const std::string &assignment : assignments_of(parameters, point))
    digest.add(assignment);
  return digest;
}

SweepPoint PointFolders::point(const std::vector<double> &values) const
{
  SweepPoint result = {values, ""};
  result.folder     = "points/" + of_point(result).hex();
  return result;
}

std::vector<SweepPoint> PointFolders::points() const
{
  std::vector<SweepPoint> points;
  for (const std::vector<double> &values : parameters.all_points())
    points.push_back({values, ""});
  // Points from whose end others start come first.
  for (std::size_t k = 0; k < points.size(); ++k)
    for (const std::size_t p : chain_to(parameters, k))
      if (points[p].folder.empty())
        {
          Digest digest = of_point(points[p]);
          if (const auto before = parameters.point_before(p))
            digest.add(points[*before].folder);
          else if (parameters.continuation != Continuation::none)
            digest.add("the first one");
          points[p].folder = "points/" + digest.hex();
        }
  return points;
}

std::string text_of(const SweepParameters &parameters, const SweepPoint &point)
{
  std::string text;
  for (std::size_t a = 0; a < parameters.axes.size(); ++a)
    text +=
      (a > 0 ? ", " : "") + parameters.axes[a].name + " = " + to_text(point.values[a]);
  return text;
}

std::vector<std::string> assignments_of(const SweepParameters &parameters,
                                        const SweepPoint &point)
{
  // Two axes may change one list. Sorted, so that the order of the axes does not matter.
  std::map<std::string, SweptKey> changed;
  for (std::size_t a = 0; a < parameters.axes.size(); ++a)
    for (const SweptKey &key : parameters.axes[a].keys)
      {
        SweptKey &so_far = changed.try_emplace(key.path, key).first->second;
        so_far.entry     = key.entry;
        so_far.list      = split_list(so_far.with(point.values[a]));
      }
  std::vector<std::string> result;
  for (const auto &[path, key] : changed)
    result.push_back(path + "=" + to_text(key.list));
  return result;
}

bool has_ended(const std::string &folder)
{
  const nlohmann::json json = marked(folder);
  return json.is_object() && !json.value("again", false);
}

FastestGrowth fastest_growth(const std::string &folder)
{
  const std::string of_modes = folder + complex_modes_folder;
  if (marked(of_modes).is_null())
    return std::nullopt;
  SweepResult modes;
  add_run(of_modes, "", modes);
  const auto missing = modes.numbers.find("missing_modes");
  const auto growth  = modes.numbers.find("largest_growth_rate");
  if (missing == modes.numbers.end() || missing->second != 0.)
    return std::nullopt;
  return growth != modes.numbers.end() ? growth->second
                                       : -std::numeric_limits<double>::infinity();
}

SweepResult read_point(const std::string &folder, const SweepParameters &parameters)
{
  SweepResult result;
  const std::string second = folder + complex_modes_folder;
  const bool was_run       = !marked(folder).is_null();
  const bool is_skipped    = !was_run && parameters.skip_stable && is_stable(folder);
  if ((!was_run && !is_skipped) || (parameters.complex_modes && marked(second).is_null()))
    return result;
  if (was_run)
    add_run(folder, "", result);
  if (parameters.complex_modes)
    add_run(second, "complex_modes.", result);
  if (is_skipped)
    {
      result.status          = SweepStatus::skipped;
      result.texts["regime"] = "steady sliding, not run";
    }
  return result;
}

void mark_point(const std::string &folder, const std::string &message, const bool again)
{
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  write_file(folder + "/" + mark,
             nlohmann::json({{"message", message}, {"again", again}}).dump(2) + "\n");
}
} // namespace mesoslip
