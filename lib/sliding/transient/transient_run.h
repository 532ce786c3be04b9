#ifndef mesoslip_sliding_transient_transient_run_h
#define mesoslip_sliding_transient_transient_run_h

#include "dynamics/stability_monitor.h"
#include "observation/probe_recorder.h"
#include "observation/snapshot_recorder.h"
#include "observation/steady_record.h"
#include "observation/steady_state.h"
#include "sliding/sliding_body.h"
#include "sliding/transient/dynamics_output.h"
#include "sliding/transient/transient.h"
#include "sliding/transient/transient_checkpoint.h"

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>

namespace mesoslip
{
class RunContext;

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
  TransientObservations run();

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

  /** Column of the reference contact node M. */
  static unsigned int reference_node(const ContactParameters &parameters,
                                     const UniformGrid<2> &grid);
  static SlidingSetup sliding_setup(const ContactParameters &parameters,
                                    const BodyDescription &body,
                                    const TimeStepChoice &time);
  static LimitCycleCriterion limit_cycle_criterion(const ContactParameters &parameters,
                                                   const UniformGrid<2> &grid);
  /** Positions of the probes, moved to the nearest node where that is wanted. */
  std::vector<ProbeRecorder::Point> probe_points() const;
  /** Zero where the body is held. */
  void set_initial_velocity();
  void judge(const Deformation &found, const std::uint64_t n);
  /** Hands on the latest samples; false: one is not finite. Collective. */
  bool observe();
  Request request(const std::uint64_t n);
  /** The greatest of all ranks, after looking and reporting. */
  Request request_of_all(const std::uint64_t n);
  bool control(const std::uint64_t n);
  std::unique_ptr<SnapshotRecorder> make_snapshots();
  /** @p object of the rank that has the top. */
  template <class T>
  T of_top(T object) const;
  TransientObservations collect();

  const ContactParameters &parameters;
  const BodyDescription &description;
  const TimeStepChoice &time;
  const UniformMaterial &material;
  TransientCheckpoint &checkpoint;
  DynamicsOutput &output;
  RunContext &context;
  SlidingBody body;
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
