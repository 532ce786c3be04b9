#ifndef mesoslip_sliding_transient_transient_run_h
#define mesoslip_sliding_transient_transient_run_h

#include "dynamics/stability_monitor.h"
#include "observation/steady_state.h"
#include "sliding/sliding_body.h"
#include "sliding/transient/dynamics_output.h"
#include "sliding/transient/transient_checkpoint.h"

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
    archive &body &monitor &strains &limit_cycle &statistics &loop_seconds;
    if (probes)
      archive &*probes;
  }

  /** Where the run stands. */
  CheckpointPosition position() const;

private:
  /** What the ranks have to say between two steps; the largest wins. */
  enum class Request : int
  {
    go_on,
    save, ///< the interval of the checkpoints is over
    stop, ///< by a signal or a file
    end,  ///< End time or limit cycle
    look  ///< something is not finite
  };

  /** Zero where the body is held. */
  void set_initial_velocity();
  /** Ends the run if a cell is inside out, and warns once of large strains. */
  void judge(const Deformation &found, const std::uint64_t n);
  /** Of this rank, after the latest samples were handed on. Collective. */
  Request request(const std::uint64_t n);
  /** Does what the ranks want; false: the run ends. */
  bool control(const std::uint64_t n);
  /** Adds the wall-clock time since the last call to loop_seconds. */
  void count_time();
  TransientResult collect();

  const ContactParameters &parameters;
  const BodyDescription &description;
  const TimeStepChoice &time;
  const UniformMaterial &material;
  TransientCheckpoint &checkpoint;
  DynamicsOutput &output;
  RunContext &context;
  SlidingBody<2> body;
  ContactRecorder<2> recent_contact; ///< since the last control
  TopRecorder recent_top;            ///< since the last control
  StabilityMonitor monitor;
  DeformationWatch strains;
  LimitCycleWatch limit_cycle;
  bool warned = false; ///< of large strains
  SteadyRecord statistics;
  bool interrupted    = false;
  bool at_limit_cycle = false;
  double loop_seconds = 0.; ///< in earlier runs, too

  std::chrono::steady_clock::time_point counted; ///< loop_seconds reach up to here

  std::unique_ptr<ProbeRecorder> probes;
};
} // namespace mesoslip

#endif
