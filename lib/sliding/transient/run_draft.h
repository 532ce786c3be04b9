#ifndef mesoslip_sliding_transient_run_draft_h
#define mesoslip_sliding_transient_run_draft_h

#include "io/hdf5_file.h"
#include "observation/probe_recorder.h"
#include "sliding/run_plan.h"

#include <vector>

namespace mesoslip
{
/**
 * @name Drafts of dynamics.h5 A draft contains the data that stress_localization needs
 * for --validate, under a DraftMark of empty files: the body of the run, its conditions,
 * and times and places of snapshots and probes, without their values. @{
 */

/** Draft of a run with one snapshot, or of its counter body; @p points is the shape of
 * the displacement. */
void write_static_draft(Hdf5File &file,
                        const ContactParameters &parameters,
                        const Shape &points,
                        const bool is_below = false);

/** Draft of a transient run, or of its counter body; steady part as without a limit
 * cycle. */
void write_transient_draft(Hdf5File &file,
                           const ContactParameters &parameters,
                           const TimeStepChoice &time,
                           const Shape &points,
                           const bool is_below = false);

/** Adds a probe at @p position to a draft of a transient run. */
void add_draft_probe(Hdf5File &file,
                     const std::string &name,
                     const std::vector<double> &position,
                     const unsigned int interval,
                     const TimeStepChoice &time);
/** @} */
} // namespace mesoslip

#endif
