#include "sliding/sweep/sweep_analysis.h"

#include "base/errors.h"
#include "base/exchange.h"
#include "base/files.h"
#include "base/object_exchange.h"
#include "base/text.h"
#include "base/timer.h"
#include "io/json.h"
#include "material/plausibility.h"
#include "parameters/keys.h"
#include "program/run_context.h"
#include "program/workers.h"
#include "sliding/sweep/run_end.h"

#include <algorithm>
#include <filesystem>
#include <ostream>
#include <sstream>

namespace mesoslip
{
namespace
{
/** The unit of a key, given in brackets at the end of its meaning. */
std::string unit_of(const Keys &keys, const std::string &path)
{
  for (const Key &key : keys.all())
    if (key.path() == path)
      {
        const auto begin = key.meaning.rfind('['), end = key.meaning.rfind(']');
        if (begin != std::string::npos && end == key.meaning.size() - 1)
          return key.meaning.substr(begin + 1, end - begin - 1);
      }
  return "-";
}

} // namespace

SweepAnalysis::SweepAnalysis(const SweepParameters &wanted,
                             const Keys &keys,
                             const Application &program)
  : parameters(wanted)
  , single(program)
  , dim(keys.value("Dimension") == "3" ? 3 : 2)
{
  for (const SweepAxis &axis : parameters.axes)
    units.push_back(axis.keys.empty() ? "-" : unit_of(keys, axis.keys[0].path));
  std::ostringstream text;
  print_given(keys, text, {"Output folder", "Sweep/"});
  base = text.str();
  on_root(MPI_COMM_WORLD, [&]() {
    folders = std::make_unique<PointFolders>(parameters, keys);
    points  = folders->points();
  });
  if (mpi::this_mpi_process(MPI_COMM_WORLD) > 0)
    for (const std::vector<double> &values : parameters.all_points())
      points.push_back({values, ""});
  for (SweepPoint &point : points)
    broadcast(MPI_COMM_WORLD, point.folder);
  for (std::size_t a = 0; a < parameters.axes.size(); ++a)
    {
      const auto by_axis = [a](const SweepPoint &one, const SweepPoint &other) {
        return one.values[a] < other.values[a];
      };
      const auto [least, largest] =
        std::minmax_element(points.begin(), points.end(), by_axis);
      check(*least, {}, false);
      check(*largest, {}, false);
    }
  for (std::size_t k = 0; k < points.size(); ++k)
    if (const auto before = parameters.point_before(k))
      {
        check(points[k], {"Time/Continue from=" + points[*before].folder}, false);
        break;
      }
  check(points.front(), {}, true);
}

/** Checks that the keys of @p point and further @p assignments are compatible; with
 * @p builds it also builds the analysis, which reads the input files. */
void SweepAnalysis::check(const SweepPoint &point,
                          const std::vector<std::string> &assignments,
                          const bool builds)
{
  try
    {
      RawParameters raw = RawParameters::parse(base, base_file);
      for (const std::string &assignment : assignments_of(parameters, point))
        raw.override_with(assignment);
      for (const std::string &assignment : assignments)
        raw.override_with(assignment);
      raw.ignore_unused(); // unused keys were checked for the whole map
      Keys keys(raw);
      single.declare(keys);
      keys.apply();
      single.declare(keys);
      if (builds)
        first = single.build(keys);
    }
  catch (const UserError &error)
    {
      throw UserError("the point " + text_of(parameters, point) +
                      " of the map (Sweep): " + error.what());
    }
}

ResourceNeed SweepAnalysis::need() const
{
  constexpr double of_folder  = 5e4; // log, parameters, summary
  const ResourceNeed of_point = first->need();
  const double n              = static_cast<double>(points.size());
  if (parameters.keep_results)
    return {n * (of_point.bytes + of_folder),
            "set Sweep/Keep results = false, or " + of_point.remedy};
  return {of_point.bytes * std::max(1U, available_cores()) + n * of_folder,
          "take fewer points, or " + of_point.remedy};
}

std::string SweepAnalysis::size_text() const
{
  std::string text = "Map of " + std::to_string(points.size()) + " points over ";
  for (std::size_t a = 0; a < parameters.axes.size(); ++a)
    {
      const SweepAxis &axis = parameters.axes[a];
      const std::vector<double> ends =
        axis.values.empty() ? std::vector<double>{axis.from, axis.to} : axis.values;
      const auto [least, largest] = std::minmax_element(ends.begin(), ends.end());
      text += (a > 0 ? ", " : "") + axis.name + " (" +
              (axis.values.empty() ? "random"
                                   : std::to_string(axis.values.size()) + " values") +
              brief_text(6, " from ", *least, " to ", *largest, " ", units[a], ")");
    }
  return text;
}

void SweepAnalysis::describe(std::ostream &out) const
{
  out << size_text() << "\nThe first point, " << text_of(parameters, points[0]) << ":\n";
  first->describe(out);
}

/** Why a point failed: by itself, or because its neighbour left no end. */
std::string SweepAnalysis::cause(const Task &task,
                                 const Outcome &outcome,
                                 const RunContext &context) const
{
  const auto before =
    task.is_of_modes ? std::nullopt : parameters.point_before(task.point);
  std::error_code ignored;
  if (!before || std::filesystem::exists(
                   run_end_file(context.file(points[*before].folder)), ignored))
    return outcome.message;
  return "it starts from the end of " + text_of(parameters, points[*before]) +
         ", which failed";
}

/** Called on rank 0. */
void SweepAnalysis::finish(const Task &task, const Outcome &outcome, RunContext &context)
{
  const std::string folder  = context.file(task.folder);
  const bool failed         = outcome.status != ExitStatus::done;
  const std::string message = failed ? cause(task, outcome, context) : "";
  // What the machine, a full disk, a folder in use or a neighbour caused may not recur.
  mark_point(folder, failed ? message + "." : "",
             outcome.status == ExitStatus::unexpected ||
               outcome.status == ExitStatus::user_error);
  if (failed)
    context.log("failed: " + text_of(parameters, points[task.point]) + ": " + message);
  if (!parameters.keep_results)
    remove_results(folder);
  context.progress().update(++n_ended);
}

/** Computes tasks.
 * @return false if it was stopped. Collective. */
bool SweepAnalysis::compute(const std::vector<Task> &tasks, RunContext &context)
{
  const unsigned int n_processes =
    parameters.processes > 0 ? parameters.processes : available_cores();
  const std::string &folder = context.output_folder();
  const std::string file    = file_of_program(single.name);
  const auto before         = tasks_before(tasks);
  if (context.n_ranks() == 1 && n_processes > 1 && tasks.size() > 1 && !file.empty())
    return carry_out_side_by_side(
      file, n_processes, context.file("processes.log"),
      {tasks.size(), [&](const std::size_t k) { return before[k]; },
       [&](const std::size_t k) { return words(tasks[k], folder); },
       [&](const std::size_t k, const Outcome &outcome) {
         finish(tasks[k], outcome, context);
       },
       [&]() { return context.stop_requested(); }});
  for (const Task &task : tasks)
    {
      if (context.stop_requested())
        return false;
      std::vector<std::string> line;
      on_root(context.communicator(), [&]() { line = words(task, folder); });
      broadcast_object(context.communicator(), line);
      const Outcome outcome = carry_out(line, single, context.communicator());
      if (outcome.status == ExitStatus::interrupted)
        return false;
      on_root(context.communicator(), [&]() { finish(task, outcome, context); });
    }
  return true;
}

void SweepAnalysis::write_results(RunContext &context) const
{
  SweepMap map       = {parameters, units, dim, points, {}, border};
  std::size_t n_done = 0, n_skipped = 0, n_of_failed = 0, n_with_warnings = 0;
  for (const SweepPoint &point : points)
    {
      map.results.push_back(read_point(context.file(point.folder), parameters));
      const SweepResult &result = map.results.back();
      n_done += result.status == SweepStatus::done;
      n_skipped += result.status == SweepStatus::skipped;
      n_of_failed += result.status == SweepStatus::failed;
      const auto warnings = result.numbers.find("warnings");
      n_with_warnings += warnings != result.numbers.end() && warnings->second > 0.;
    }
  write_map_file(context.file("map.h5"), map);
  write_map_table(context.file("map.csv"), map);
  if (border)
    write_border_table(context.file("border.csv"), map);
  nlohmann::json axes = nlohmann::json::array();
  for (std::size_t a = 0; a < parameters.axes.size(); ++a)
    axes.push_back({{"name", parameters.axes[a].name},
                    {"keys", texts_of(parameters.axes[a].keys)},
                    {"unit", units[a]}});
  context.summary().update({{"analysis", "map"},
                            {"axes", axes},
                            {"shape", parameters.shape()},
                            {"points", points.size()},
                            {"points_done", n_done},
                            {"points_skipped", n_skipped},
                            {"points_failed", n_of_failed},
                            {"points_with_warnings", n_with_warnings}});
  context.log(
    std::to_string(n_done) + " of " + std::to_string(points.size()) + " points are done" +
    (n_skipped > 0
       ? ", " + std::to_string(n_skipped) + " are not run, as their vibrations decay"
       : "") +
    (n_of_failed > 0 ? ", " + std::to_string(n_of_failed) + " failed" : "") +
    ": map.h5, map.csv" +
    (border ? ", border.csv (" + std::to_string(border->size()) + " points)" : ""));
  if (n_of_failed > 0)
    context.warn(
      std::to_string(n_of_failed) + " of " + std::to_string(points.size()) +
      " points failed; map.csv says why. The same command tries again what was "
      "refused or stopped, and a point whose folder is removed");
  if (n_with_warnings > 0)
    context.warn(std::to_string(n_with_warnings) +
                 " points have warnings, which stand in the "
                 "log.txt of their folders");
}

/** Computes the missing runs of @p kinds of the points from number @p first on.
 * @return false if it was stopped. Collective. */
bool SweepAnalysis::compute_missing(const std::string &title,
                                    const std::size_t first,
                                    const Kinds &kinds,
                                    RunContext &context)
{
  std::vector<Task> tasks;
  on_root(context.communicator(), [&]() {
    tasks = missing_tasks(context.output_folder(), first, kinds);
    wait_for_others(tasks, context);
  });
  broadcast_object(context.communicator(), tasks);
  const std::size_t n_runs = (points.size() - first) * kinds.size();
  n_tasks                  = tasks.size();
  n_ended                  = 0;
  if (n_tasks < n_runs && first == 0)
    context.log(std::to_string(n_runs - n_tasks) + " of " + std::to_string(n_runs) +
                (parameters.skip_stable && kinds == Kinds{false}
                   ? " points are there already, or not run as their vibrations decay"
                   : " runs are there already"));
  context.progress().start(title, std::max<std::size_t>(1, n_tasks));
  bool is_complete = false;
  {
    const auto scope = context.timer().scope("Points");
    is_complete      = compute(tasks, context);
  }
  context.progress().finish();
  return is_complete;
}

void SweepAnalysis::run(RunContext &context)
{
  is_trial = context.options().trial;
  on_root(context.communicator(), [&]() { write_file(context.file(base_file), base); });
  context.log(size_text());
  // With skip_stable, modes come first: they decide which points need not be run.
  const bool is_complete =
    parameters.skip_stable
      ? compute_missing("Modes", 0, {true}, context) &&
          compute_missing("Map", 0, {false}, context)
      : compute_missing("Map", 0,
                        parameters.complex_modes ? Kinds{false, true} : Kinds{false},
                        context);
  const bool has_border =
    is_complete && (!parameters.wants_border() || find_border(context));
  on_root(context.communicator(), [&]() { write_results(context); });
  if (!has_border)
    throw Interrupted("the map was stopped with " + std::to_string(n_tasks - n_ended) +
                      " runs left; the same command computes the rest");
}
} // namespace mesoslip
