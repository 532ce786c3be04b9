#include "sliding/sweep/sweep_points.h"

#include "base/digest.h"
#include "base/errors.h"
#include "base/files.h"
#include "base/text.h"
#include "base/version.h"
#include "parameters/keys.h"

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

namespace mesoslip
{
namespace
{
namespace fs = std::filesystem;

/** In the folder of a point that has ended. */
constexpr char mark[] = "point.json";

/** Of the run, not of what it found: they differ from run to run, or are those of the body. */
const std::set<std::string> not_of_the_point = {
  "cell_updates_per_second", "cells",   "dim",   "dofs",    "draft",  "kernel",
  "peak_memory_bytes",       "program", "ranks", "seconds", "version"};

/** Numbers and texts of @p node; those of members are named by both. */
void take(const nlohmann::json &node, const std::string &name, PointResult &result)
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

/** Everything in summary.json of @p folder that is a single number or text, with @p prefix before its name. */
void take_summary(const std::string &folder,
                  const std::string &prefix,
                  PointResult &result)
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

/** Content of the files that @p keys name. */
void add_inputs(const Keys &keys, Digest &digest)
{
  for (const Key &key : keys.all())
    for (const std::string &input : key.inputs())
      {
        std::error_code ignored;
        if (fs::is_regular_file(input, ignored))
          digest.add_file(input);
      }
}

/** Adds to @p result what @p folder holds of a run, if it has ended. */
void add_run(const std::string &folder, const std::string &prefix, PointResult &result)
{
  if (!has_ended(folder))
    return;
  result.status   = std::max(result.status, PointStatus::done);
  const auto json = nlohmann::json::parse(read_file(folder + "/" + mark), nullptr, false);
  const std::string message =
    json.is_object() ? json.value("message", std::string()) : "";
  if (message.empty())
    return take_summary(folder, prefix, result);
  result.status = PointStatus::failed;
  result.message += (result.message.empty() ? "" : "; ") + message;
}
} // namespace

std::vector<SweepPoint> points_of(const SweepParameters &parameters, const Keys &keys)
{
  std::vector<std::string> skip = {"Output folder", "Checkpoints/", "Sweep/"};
  for (const SweepAxis &axis : parameters.axes)
    skip.insert(skip.end(), axis.keys.begin(), axis.keys.end());
  Digest common;
  common.add(version).add(canonical_parameters(keys, skip));
  add_inputs(keys, common);
  std::vector<SweepPoint> points;
  for (const std::vector<double> &values : parameters.all_points())
    {
      points.push_back({values, ""});
      // In the order of their names, so that the order of the axes does not matter.
      const auto assignments = assignments_of(parameters, points.back());
      Digest digest          = common;
      for (const std::string &assignment :
           std::set<std::string>(assignments.begin(), assignments.end()))
        digest.add(assignment);
      points.back().folder = "points/" + digest.hex();
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
  std::vector<std::string> result;
  for (std::size_t a = 0; a < parameters.axes.size(); ++a)
    for (const std::string &key : parameters.axes[a].keys)
      result.push_back(key + "=" + to_text(point.values[a]));
  return result;
}

bool has_ended(const std::string &folder)
{
  std::error_code ignored;
  return fs::is_regular_file(folder + "/" + mark, ignored);
}

PointResult read_point(const std::string &folder, const bool complex_modes)
{
  PointResult result;
  const std::string second = folder + complex_modes_folder;
  if (!has_ended(folder) || (complex_modes && !has_ended(second)))
    return result;
  add_run(folder, "", result);
  if (complex_modes)
    add_run(second, "complex_modes.", result);
  return result;
}

void mark_point(const std::string &folder, const std::string &message)
{
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  write_file(folder + "/" + mark, nlohmann::json({{"message", message}}).dump(2) + "\n");
}
} // namespace mesoslip
