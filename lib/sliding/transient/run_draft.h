#ifndef mesoslip_sliding_transient_run_draft_h
#define mesoslip_sliding_transient_run_draft_h

#include "io/hdf5_file.h"
#include "observation/probe_recorder.h"
#include "sliding/run_plan.h"

#include <vector>

namespace mesoslip
{
/**
 * @name Drafts of dynamics.h5
 * What stress_localization checks itself with is in the draft, under a DraftMark of empty
 * files: after the body, which is that of the run, its conditions, and times and places of
 * snapshots and probes, whose values are missing.
 * @{
 */

/** Of a run with one snapshot, whose displacement has the extents @p points, or of its counter body. */
void write_static_draft(Hdf5File &file,
                        const ContactParameters &parameters,
                        const Shape &points,
                        const bool is_below = false);

/** Of a transient run, or of its counter body; the steady part is that of a run without a limit cycle. */
void write_transient_draft(Hdf5File &file,
                           const ContactParameters &parameters,
                           const TimeStepChoice &time,
                           const Shape &points,
                           const bool is_below = false);

/** Adds a probe, at @p position, of a transient run. */
void add_draft_probe(Hdf5File &file,
                     const std::string &name,
                     const std::vector<double> &position,
                     const unsigned int interval,
                     const TimeStepChoice &time);
/** @} */
} // namespace mesoslip

#endif
