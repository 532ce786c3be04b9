#ifndef mesoslip_sliding_transient_run_needs_h
#define mesoslip_sliding_transient_run_needs_h

#include "program/output_folder.h"
#include "sliding/run_plan.h"

namespace mesoslip
{
/** What a transient run keeps in memory besides its fields, and writes. */
struct RunNeeds
{
  double n_snapshots   = 0.; ///< at most one a step
  double n_map_samples = 0.; ///< of the map of the contact
  double map_bytes     = 0.; ///< of the map of the contact on the disk
  ResourceNeed memory;       ///< of the histories, which are kept until the end
  ResourceNeed disk;         ///< of dynamics.h5 and the checkpoints when it is largest

  /** "40 snapshots, map of the contact with 1000 samples (16 MB)". */
  std::string text() const;
};

/**
 * Of a run on a body whose displacement has @p n_dofs numbers, with @p n_contact nodes of the
 * contact. @throws UserError when snapshots or map begin after the end
 */
RunNeeds run_needs(const ContactParameters &parameters,
                   const BodyScales &scales,
                   const TimeStepChoice &time,
                   const double n_dofs,
                   const double n_contact);

/** The steps, before the last one, nearest to Snapshots/From, From + Interval, ... up to To, or
 * every step where the interval is shorter. */
std::vector<std::uint64_t> snapshot_steps(const ContactParameters &parameters,
                                          const TimeStepChoice &time);
} // namespace mesoslip

#endif
