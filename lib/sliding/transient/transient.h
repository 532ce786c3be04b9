#ifndef mesoslip_sliding_transient_transient_h
#define mesoslip_sliding_transient_transient_h

#include "dynamics/stability_monitor.h"
#include "sliding/body_analysis.h"
#include "sliding/run_plan.h"
#include "sliding/sliding_body.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/dynamics_output.h"
#include "sliding/transient/run_needs.h"
#include "sliding/transient/run_statistics.h"

#include <chrono>
#include <cstdint>
#include <memory>

namespace mesoslip
{
/**
 * One run: the body, its boundaries and its observers; everything that changes from step
 * to step, and when it is saved. All ranks call the members.
 */
class TransientRun
{
public:
  /** The initial state; all arguments must outlive it. */
  TransientRun(const ContactParameters &parameters,
               const BodyDescription &description,
               const TimeStepChoice &time,
               const UniformMaterial &material,
               TransientCheckpoint &checkpoint,
               DynamicsOutput &output,
               RunContext &context);

  /** Takes over the state in the checkpoint. */
  void restore();

  /**
   * Goes on until End time, the limit cycle or a request to stop, after which the state
   * is in the checkpoint. @throws NumericalFailure
   */
  TransientResult run();

  /** Puts the state into the checkpoint. */
  void save();

  /** State between two steps (Boost.Serialization); observers come and go with the keys.
   */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &body &monitor &strains &statistics &loop_seconds;
    if (probes)
      archive &*probes;
  }

  /** Where the run stands. */
  CheckpointPosition position() const;

  /** The map of the contact; null without one. */
  const ContactMapOutput<2> *contact_map() const
  {
    return map.get();
  }

private:
  /** Zero where the body is held. */
  void set_initial_velocity();
  /** Ends the run if a cell is inside out, and warns once of large strains. */
  void judge(const Deformation &found, const std::uint64_t n);
  /** Does what the ranks want; false: the run ends. */
  bool control(const std::uint64_t n);
  /** Adds the wall-clock time since the last call to loop_seconds. */
  void count_time();
  TransientResult collect();

  const ContactParameters &parameters;
  const BodyDescription &description;
  const TimeStepChoice &time;
  const BodyScales scales;
  const PlaceText place; ///< of a cell
  TransientCheckpoint &checkpoint;
  DynamicsOutput &output;
  RunContext &context;
  const BodySize size;
  SlidingBody<2> body;
  StabilityMonitor monitor;
  DeformationWatch strains;
  RunStatistics<2> statistics;
  bool warned         = false; ///< of large strains
  bool interrupted    = false;
  bool at_limit_cycle = false;
  double loop_seconds = 0.; ///< in earlier runs, too

  std::chrono::steady_clock::time_point counted; ///< loop_seconds reach up to here

  std::unique_ptr<ProbeRecorder> probes;
  std::unique_ptr<ContactMapOutput<2>> map;
};

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
  const std::string identity; ///< lines "key = value"
  RunNeeds needs;             ///< estimated from above
};
} // namespace mesoslip

#endif
