#include "localization/comparison/run_comparison.h"

#include "base/errors.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
/** Times of the snapshots of a run in a window, of which there is one at least. */
std::vector<double> times_in(const DynamicsFile &run, const TimeWindow &window)
{
  const auto times       = run.snapshot_times();
  const IndexRange range = snapshots_in(run, window);
  const auto first       = times.begin() + static_cast<std::ptrdiff_t>(range.first);
  return {first, first + static_cast<std::ptrdiff_t>(range.count)};
}

double mean_interval(const std::vector<double> &times)
{
  return times.size() < 2
           ? 0.
           : (times.back() - times.front()) / static_cast<double>(times.size() - 1);
}

std::string span_text(const DynamicsFile &run, const std::vector<double> &times)
{
  return run.path() + " are from " + to_text(times.front()) + " to " +
         to_text(times.back()) + " s";
}
} // namespace

std::vector<ConditionDifference> compare_conditions(const DynamicsFile &homogeneous,
                                                    const DynamicsFile &direct,
                                                    const bool allow_different_loads,
                                                    std::vector<std::string> &notes,
                                                    std::vector<std::string> &warnings)
{
  for (const DynamicsFile *run : {&homogeneous, &direct})
    if (!run->conditions)
      warnings.push_back(run->path() + " does not tell its loads, as an earlier version "
                                       "wrote it: whether both runs were made under the "
                                       "same is not known");
  if (!homogeneous.conditions || !direct.conditions)
    return {};
  const auto differences =
    condition_differences(*homogeneous.conditions, *direct.conditions);
  const std::string loads    = differences_text(differences, true);
  const std::string method   = differences_text(differences, false);
  const std::string sentence = "the homogeneous run " + homogeneous.path() +
                               " and the direct run " + direct.path() +
                               " were made under different conditions (" + loads +
                               "), so their difference is not the error of localization";
  if (!loads.empty() && !allow_different_loads)
    throw UserError(sentence + "; run both under the same, or set "
                               "Input/Allow different loads = true");
  if (!loads.empty())
    warnings.push_back(sentence);
  if (!method.empty())
    notes.push_back("Homogeneous and direct run differ: " + method);
  return differences;
}

double steady_from(const DynamicsFile &run)
{
  const RunConditions conditions = run.conditions.value_or(RunConditions());
  const auto analysis            = conditions.find("analysis");
  if (analysis != conditions.end() &&
      std::get<std::string>(analysis->second) == "static contact")
    return -std::numeric_limits<double>::infinity();
  const auto from = number_of(conditions, "steady_from");
  if (!from)
    throw UserError(
      "Window/From is auto, but " + run.path() +
      " does not tell from when on the run is steady, as an earlier version "
      "wrote it; give a time in s, or run contact_dynamics again");
  return *from;
}

IndexRange snapshots_in(const DynamicsFile &run, const TimeWindow &window)
{
  const auto times       = run.snapshot_times();
  const IndexRange range = entries_in(times, window);
  if (times.empty())
    throw UserError(run.path() + ": /snapshots is empty; run contact_dynamics until "
                                 "after Snapshots/From");
  if (range.count == 0)
    throw UserError(run.path() + ": no snapshot lies between " + to_text(window.begin) +
                    " and " + to_text(window.end) + " s, its " +
                    std::to_string(times.size()) + " go from " + to_text(times.front()) +
                    " to " + to_text(times.back()) + " s; change Window/From and To");
  return range;
}

TimeWindow shared_snapshots(const DynamicsFile &one,
                            const DynamicsFile &other,
                            const TimeWindow &window)
{
  const std::vector<double> a = times_in(one, window), b = times_in(other, window);
  if (a.size() == 1 && b.size() == 1)
    return window;
  const double slack      = 0.5 * std::max(mean_interval(a), mean_interval(b));
  const TimeWindow shared = window.intersection(
    {std::max(a.front(), b.front()) - slack, std::min(a.back(), b.back()) + slack});
  if (entries_in(a, shared).count == 0 || entries_in(b, shared).count == 0)
    throw UserError("the snapshots of the two runs have no time in common: those of " +
                    span_text(one, a) + ", those of " + span_text(other, b) +
                    "; run contact_dynamics with the same Snapshots/From and To");
  return shared;
}
} // namespace mesoslip
