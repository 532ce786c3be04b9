#ifndef mesoslip_sliding_transient_transient_h
#define mesoslip_sliding_transient_transient_h

#include "sliding/body_analysis.h"
#include "sliding/run_plan.h"
#include "sliding/transient/run_needs.h"

#include <string>
#include <vector>

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
    return needs.disk;
  }

  void describe(std::ostream &out) const override;
  unsigned int useful_ranks() const override;

  bool resumable() const override
  {
    return true;
  }

  void write_draft(const std::string &folder) const override;

  /**
   * @throws Interrupted after a checkpoint and what was observed so far have been written
   * @throws NumericalFailure when the run blows up; the last checkpoint stays
   */
  void run(RunContext &context) override;

private:
  RunNeeds needs_of(const double n_steps, const unsigned int interval) const;
  std::vector<std::string> warnings() const;

  const BodyScales scales;
  const std::string identity; ///< see run_identity()
  RunNeeds needs;             ///< estimated from above
};
} // namespace mesoslip

#endif
