#ifndef mesoslip_sliding_transient_transient_h
#define mesoslip_sliding_transient_transient_h

#include "sliding/body_analysis.h"
#include "sliding/run_plan.h"

namespace mesoslip
{
class Keys;

/**
 * Explicit dynamics of the body on the moving flat: runs, observes, and leaves
 * dynamics.h5, tables and the summary in the output folder. With RunContext::resume() it
 * continues from the checkpoint there, if all keys that decide the result are the same.
 */
class TransientAnalysis : public BodyAnalysis
{
public:
  /** @p keys identify the run. @throws UserError */
  TransientAnalysis(const ContactParameters &parameters, const Keys &keys);

  ResourceNeed need() const override
  {
    return disk;
  }

  void describe(std::ostream &out) const override;

  bool resumable() const override
  {
    return true;
  }

  /**
   * @throws Interrupted after a checkpoint and what was observed so far have been written
   * @throws NumericalFailure when the run blows up; the last checkpoint stays
   */
  void run(RunContext &context) override;

private:
  /** @throws UserError if a run of @p n_steps has no samples from Steady from on. */
  void check_steady_from(const double n_steps) const;

  /**
   * Snapshots that a run of @p n_steps takes, at most one a step.
   * @throws UserError when they begin after the end
   */
  double n_snapshots(const double n_steps) const;

  /** Bytes of all that a run of @p n_steps records every few steps. */
  double history_bytes(const double n_steps) const;

  /** Memory of the histories, which are kept until the end of a run. */
  ResourceNeed history_memory(const double n_steps) const;

  /** Disk space of dynamics.h5 and the checkpoints when it is largest. */
  ResourceNeed disk_space(const double n_steps) const;

  const std::string identity; ///< lines "key = value"
  ResourceNeed disk;
};
} // namespace mesoslip

#endif
