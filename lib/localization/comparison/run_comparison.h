#ifndef mesoslip_localization_comparison_run_comparison_h
#define mesoslip_localization_comparison_run_comparison_h

#include "exchange/dynamics_file.h"

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * In what the conditions of the two runs differ, homogeneous run first; adds sentences on
 * it to @p notes and @p warnings.
 * @throws UserError, unless @p allow_different_loads, if the two were not made under the
 * same loads, supports and friction coefficient: then they differ for other reasons than
 * localization.
 */
std::vector<ConditionDifference> compare_conditions(const DynamicsFile &homogeneous,
                                                    const DynamicsFile &direct,
                                                    const bool allow_different_loads,
                                                    std::vector<std::string> &notes,
                                                    std::vector<std::string> &warnings);

/**
 * When a run is steady (s); minus infinity for a static analysis. @throws UserError
 * naming Window/From if the file does not tell.
 */
double steady_from(const DynamicsFile &run);

/**
 * The part of @p window in which both runs have snapshots, up to half of the longer
 * interval between them, so that averages are over the same time; @p window itself for
 * two static states. @throws UserError if there is none.
 */
TimeWindow shared_snapshots(const DynamicsFile &one,
                            const DynamicsFile &other,
                            const TimeWindow &window);

/** Snapshots of a run in the window. @throws UserError when there are none. */
IndexRange snapshots_in(const DynamicsFile &run, const TimeWindow &window);
} // namespace mesoslip

#endif
