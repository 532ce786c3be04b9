#ifndef mesoslip_sliding_transient_transient_h
#define mesoslip_sliding_transient_transient_h

#include "contact/contact_recorder.h"
#include "dynamics/energy_audit.h"
#include "dynamics/top_surface.h"
#include "observation/probe_recorder.h"
#include "observation/steady_record.h"
#include "sliding/body_analysis.h"
#include "sliding/transient/run_plan.h"

#include <memory>

namespace mesoslip
{
class Keys;

/** Everything a finished run has observed; complete on rank 0. */
struct TransientObservations
{
  ContactHistory contact;           ///< sampled histories
  TopHistory top;                   ///< sampled histories
  SteadySeries series;              ///< for the statistics
  std::vector<NodeCounts> blocks;   ///< contact states by node
  EnergyHistory energy;             ///< terms of the balance
  std::vector<ProbeHistory> probes; ///< in the order of the .prm

  std::uint64_t steps_done    = 0;     ///< of the whole run
  double dt                   = 0.;    ///< s
  unsigned int reference_node = 0;     ///< number on the contact line
  double loop_seconds         = 0.;    ///< wall-clock time of the time loop
  bool interrupted            = false; ///< stopped on request
  std::string kernel;                  ///< variant and instruction set
  std::string limit_cycle;             ///< the criterion and what came of it
  bool limit_cycle_reached = false;    ///< by the criterion
  double steady_from       = 0.;       ///< s
  double largest_strain    = 0.;       ///< norm of the mean strain of a cell
};

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
  const std::string identity; ///< lines "key = value"
  ResourceNeed disk;
};
} // namespace mesoslip

#endif
