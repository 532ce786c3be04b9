#include "localization/comparison/run_comparison.h"

#include "base/errors.h"
#include "parameters/parameters.h"

#include <algorithm>
#include <limits>

namespace mesoslip
{
namespace
{
/** The times of snapshots in a window, as far as they matter here. */
struct Span
{
  std::size_t count = 0;
  double first = 0., last = 0.;

  double interval() const
  {
    return count < 2 ? 0. : (last - first) / static_cast<double>(count - 1);
  }

  std::string text() const
  {
    return to_text(first) + " to " + to_text(last) + " s";
  }
};

/** Nothing if there are none. */
Span span_of(const RunFile &run, const TimeWindow &window)
{
  const auto times       = run.snapshot_times();
  const IndexRange range = entries_in(times, window);
  if (range.count == 0)
    return {};
  return {range.count, times[range.first], times[range.first + range.count - 1]};
}
} // namespace

RunComparison compare_conditions(const RunFile &homogeneous,
                                 const RunFile &direct,
                                 const bool allow_different_loads)
{
  RunComparison result;
  for (const RunFile *run : {&homogeneous, &direct})
    if (!run->conditions())
      result.warnings.push_back(run->path() + " does not tell its loads, as an earlier "
                                              "version wrote it: whether both runs were "
                                              "made under the same is not known");
  if (!result.warnings.empty())
    return result;
  result.differences =
    condition_differences(*homogeneous.conditions(), *direct.conditions());
  const std::string loads    = differences_text(result.differences, true);
  const std::string method   = differences_text(result.differences, false);
  const std::string sentence = "the homogeneous run " + homogeneous.path() +
                               " and the direct run " + direct.path() +
                               " were made under different conditions (" + loads +
                               "), so their difference is not the error of localization";
  if (!loads.empty() && !allow_different_loads)
    throw UserError(sentence + "; run both under the same, or set "
                               "Input/Allow different loads = true");
  if (!loads.empty())
    result.warnings.push_back(sentence);
  if (!method.empty())
    result.notes.push_back("Homogeneous and direct run differ: " + method);
  return result;
}

double steady_from(const RunFile &run)
{
  const auto &conditions = run.conditions();
  if (conditions && conditions->words.count("analysis") > 0 &&
      conditions->words.at("analysis") == "static contact")
    return -std::numeric_limits<double>::infinity();
  const auto from = conditions ? conditions->number("steady_from") : std::nullopt;
  if (!from)
    throw UserError(
      "Window/From is auto, but " + run.path() +
      " does not tell from when on the run is steady, as an earlier version "
      "wrote it; give a time in s, or run contact_dynamics again");
  return *from;
}

TimeWindow
shared_snapshots(const RunFile &one, const RunFile &other, const TimeWindow &window)
{
  const Span a = span_of(one, window), b = span_of(other, window);
  // Without any snapshots_in() says more.
  if (a.count == 0 || b.count == 0 || (a.count == 1 && b.count == 1))
    return window;
  const double slack      = 0.5 * std::max(a.interval(), b.interval());
  const TimeWindow shared = window.intersection(
    {std::max(a.first, b.first) - slack, std::min(a.last, b.last) + slack});
  if (span_of(one, shared).count == 0 || span_of(other, shared).count == 0)
    throw UserError("the snapshots of the two runs have no time in common: those of " +
                    one.path() + " are from " + a.text() + ", those of " + other.path() +
                    " from " + b.text() +
                    "; run contact_dynamics with the same Snapshots/From and To");
  return shared;
}
} // namespace mesoslip
