#ifndef mesoslip_localization_comparison_run_comparison_h
#define mesoslip_localization_comparison_run_comparison_h

#include "exchange/run_conditions.h"
#include "exchange/run_file.h"
#include "exchange/time_window.h"

#include <string>
#include <vector>

namespace mesoslip
{
/** In what the homogeneous and the direct run differ, and what is to be said of it. */
struct RunComparison
{
  std::vector<ConditionDifference> differences; ///< homogeneous run first
  std::vector<std::string> notes;               ///< sentences for the log
  std::vector<std::string> warnings;            ///< sentences that are more than that
};

/**
 * @throws UserError, unless @p allow_different_loads, if the two were not made under the
 * same loads, supports and friction coefficient: then they differ for other reasons than
 * localization.
 */
RunComparison compare_conditions(const RunFile &homogeneous,
                                 const RunFile &direct,
                                 const bool allow_different_loads);

/**
 * When a run is steady (s); minus infinity for a static analysis. @throws UserError
 * naming Window/From if the file does not tell.
 */
double steady_from(const RunFile &run);

/**
 * The part of @p window in which both runs have snapshots, up to half of the longer
 * interval between them, so that averages are over the same time; @p window itself for
 * two static states. @throws UserError if there is none.
 */
TimeWindow
shared_snapshots(const RunFile &one, const RunFile &other, const TimeWindow &window);
} // namespace mesoslip

#endif
