#include "base/files.h"
#include "program/folder_lock.h"
#include "program/run_context.h"
#include "sliding/sweep/run_end.h"
#include "sliding/sweep/sweep_analysis.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <thread>

namespace mesoslip
{
namespace
{
/** Files with results in @p folder. */
std::vector<std::filesystem::path> results_in(const std::string &folder)
{
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto &entry : std::filesystem::directory_iterator(folder, ignored))
    {
      const std::string kind = entry.path().extension().string();
      if (kind == ".h5" || kind == ".csv" || kind == ".xdmf")
        found.push_back(entry.path());
    }
  return found;
}
} // namespace

/** Removes the files of a point except its summary. */
void SweepAnalysis::remove_results(const std::string &folder) const
{
  std::error_code ignored;
  for (const auto &file : results_in(folder))
    std::filesystem::remove(file, ignored);
  std::filesystem::remove(folder + "/" + single.name + ".checkpoint", ignored);
}

/** Whether the run in @p folder has ended, with its results if they have to be kept. */
bool SweepAnalysis::is_there(const std::string &folder, const bool is_of_modes) const
{
  std::error_code ignored;
  if (parameters.continuation != Continuation::none && !is_of_modes &&
      !std::filesystem::exists(run_end_file(folder), ignored) &&
      std::filesystem::exists(folder + "/summary.json", ignored))
    return false;
  return has_ended(folder) &&
         (!parameters.keep_results || !results_in(folder).empty() ||
          !std::filesystem::exists(folder + "/summary.json", ignored)); // it failed
}

std::vector<SweepAnalysis::Task> SweepAnalysis::missing_tasks(const std::string &folder,
                                                              const std::size_t first,
                                                              const Kinds &kinds) const
{
  std::vector<Task> tasks;
  std::set<std::string> wanted; // points may be repeated
  for (std::size_t k = first; k < points.size(); ++k)
    for (const bool is_of_modes : kinds)
      {
        const std::string place =
          points[k].folder + (is_of_modes ? complex_modes_folder : "");
        const std::string of_run = folder + "/" + place;
        const bool is_skipped =
          parameters.skip_stable && !is_of_modes && is_stable(of_run);
        if (!is_skipped && !is_there(of_run, is_of_modes) && wanted.insert(place).second)
          tasks.push_back({k, is_of_modes, place});
      }
  // Points come after the points from whose end they start.
  const auto n_before = [this](std::size_t k) {
    std::size_t n = 0;
    for (auto before = parameters.point_before(k); before; ++n)
      before = parameters.point_before(*before);
    return n;
  };
  if (parameters.continuation != Continuation::none && first == 0)
    std::stable_sort(tasks.begin(), tasks.end(), [&](const Task &a, const Task &b) {
      return n_before(a.point) < n_before(b.point);
    });
  return tasks;
}

/** Waits up to half a minute for runs of a map that was killed; they stop by themselves
 * and leave checkpoints. Called on rank 0. */
void SweepAnalysis::wait_for_others(const std::vector<Task> &tasks,
                                    const RunContext &context) const
{
  constexpr std::chrono::milliseconds pause(50);
  unsigned int pauses_left = 600;
  for (const Task &task : tasks)
    while (pauses_left > 0 && is_locked(context.file(task.folder)))
      {
        --pauses_left;
        std::this_thread::sleep_for(pause);
      }
}

std::vector<std::string> SweepAnalysis::words(const Task &task,
                                              const std::string &folder) const
{
  const std::string place         = folder + "/" + task.folder;
  std::vector<std::string> result = {folder + "/" + base_file, "--quiet",
                                     "--ignore-unused", "--output", place};
  for (const std::string &assignment : assignments_of(parameters, points[task.point]))
    result.insert(result.end(), {"--set", assignment});
  if (parameters.continuation != Continuation::none && !task.is_of_modes)
    {
      result.insert(result.end(), {"--set", "Checkpoints/Write end=true"});
      if (const auto before = parameters.point_before(task.point))
        result.insert(result.end(), {"--set", "Time/Continue from=" + folder + "/" +
                                                points[*before].folder});
    }
  if (task.is_of_modes)
    result.insert(result.end(), {"--set", "Analysis=complex modes"});
  if (is_trial)
    result.emplace_back("--try");
  if (!parameters.keep_results)
    result.insert(result.end(), {"--summary-only", "--set", "Snapshots/Interval=0",
                                 "--set", "Contact map/Interval=0"});
  std::error_code ignored;
  if (std::filesystem::exists(place + "/" + single.name + ".checkpoint", ignored))
    result.emplace_back("--resume");
  return result;
}

/** For each task the task from whose end it starts, if that end has still to be
 * computed. */
std::vector<std::optional<std::size_t>>
SweepAnalysis::tasks_before(const std::vector<Task> &tasks) const
{
  std::map<std::string, std::size_t> by_folder;
  for (std::size_t k = 0; k < tasks.size(); ++k)
    by_folder[tasks[k].folder] = k;
  std::vector<std::optional<std::size_t>> result(tasks.size());
  for (std::size_t k = 0; k < tasks.size(); ++k)
    if (const auto before =
          tasks[k].is_of_modes ? std::nullopt : parameters.point_before(tasks[k].point))
      if (const auto found = by_folder.find(points[*before].folder);
          found != by_folder.end())
        result[k] = found->second;
  return result;
}
} // namespace mesoslip
