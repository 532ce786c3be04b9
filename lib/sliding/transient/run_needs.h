#ifndef mesoslip_sliding_transient_run_needs_h
#define mesoslip_sliding_transient_run_needs_h

#include "program/output_folder.h"
#include "sliding/run_plan.h"

namespace mesoslip
{
/** Memory of a transient run besides its fields, and its disk space. */
struct RunNeeds
{
  double n_snapshots   = 0.; ///< at most one per step
  double n_map_samples = 0.; ///< samples of the contact map
  double map_bytes     = 0.; ///< size of the contact map on disk
  ResourceNeed memory;       ///< histories, which are kept until the end
  ResourceNeed disk;         ///< peak size of dynamics.h5 and checkpoints

  /** "40 snapshots, map of the contact with 1000 samples (16 MB)". */
  std::string text() const;
};

/**
 * Needs of a run whose displacement has @p n_dofs numbers, with @p n_contact contact
 * nodes.
 * @throws UserError if snapshots or map begin after the end
 */
RunNeeds run_needs(const ContactParameters &parameters,
                   const BodyScales &scales,
                   const TimeStepChoice &time,
                   const double n_dofs,
                   const double n_contact);

/** Steps of the snapshots: nearest to Snapshots/From, From + Interval, ... up to To,
 * before the last step; every step if the interval is shorter. */
std::vector<std::uint64_t> snapshot_steps(const ContactParameters &parameters,
                                          const TimeStepChoice &time);
} // namespace mesoslip

#endif
