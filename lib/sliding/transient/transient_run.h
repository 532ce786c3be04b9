#ifndef mesoslip_sliding_transient_transient_run_h
#define mesoslip_sliding_transient_transient_run_h

#include "dynamics/deformation.h"
#include "dynamics/stability_monitor.h"
#include "sliding/counter/counter_output.h"
#include "sliding/run_plan.h"
#include "sliding/sliding_body.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/run_output.h"
#include "sliding/transient/run_statistics.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace mesoslip
{
class Keys;

/**
 * Lines "key = value" of all input that decides the state or the output so far, bit by
 * bit; a resumed run has to match them. @p contents: lines on the files of the body.
 */
std::string run_identity(const Keys &keys,
                         const ContactParameters &parameters,
                         const std::string &contents);

/** Setup of the body of a run, without its material. */
SlidingSetup run_setup(const ContactParameters &parameters,
                       const BodySize &size,
                       const TimeStepChoice &time);

/** Setup of a counter body, of which only energies, snapshots and probes are observed. */
SlidingSetup setup_below(const ContactParameters &parameters,
                         const BodySize &size,
                         const StepParameters &step,
                         const unsigned int probe_interval);

/** Parts of a run, made by the given body; all must outlive the run. */
template <int dim>
struct RunParts
{
  const ContactParameters &parameters; ///< all of them
  const TimeStepChoice &time;          ///< steps
  const BodyScales &scales;            ///< scales of the body
  const BodySize &size;                ///< size of the body
  std::size_t n_cells;                 ///< cells of all bodies
  PlaceText place;                     ///< text of a cell's place
  SlidingBody<dim> &body;              ///< in its initial state
  ProbeRecorder *probes;               ///< null without any
  SlidingBody<dim> *counter;           ///< counter body, on ranks that hold it; else null
  ProbeRecorder *probes_below;         ///< counter body's; null without any
  CounterOutput<dim> *counter_output; ///< its snapshots, on these ranks; null without any
  RunOutput<dim> &output;             ///< dynamics.h5
  TransientCheckpoint &checkpoint;    ///< checkpoint of the run
  RunContext &context;                ///< context of the program
};

/**
 * A run: a body with its boundaries and observers, everything that changes from step to
 * step, and its checkpoints. Members are collective.
 */
template <int dim>
class TransientRun
{
public:
  /** Begins with the current state of the body. */
  explicit TransientRun(const RunParts<dim> &parts);

  /**
   * Runs (from the checkpoint if @p continued) until End time, the limit cycle or a stop
   * request, and writes all results; @p summarize_body is called on rank 0.
   * @throws Interrupted after writing a checkpoint and the results so far
   * @throws NumericalFailure if the run diverges; the last checkpoint stays
   */
  void carry_out(const bool continued, const std::function<void()> &summarize_body);

  /** State between two steps (Boost.Serialization); which observers exist depends on the
   * keys. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &parts.body &monitor &strains &statistics &loop_seconds &of_counter;
    if (parts.counter != nullptr)
      archive &*parts.counter;
    if (parts.probes != nullptr)
      archive &*parts.probes;
    if (parts.probes_below != nullptr)
      archive &*parts.probes_below;
  }

private:
  /** Ends the run if a cell is inverted, and warns once of large strains. */
  void judge(const Deformation &found, const PlaceText &place, const std::uint64_t n);
  /** judge() for a counter body. Collective. */
  void judge_counter(const std::uint64_t n);
  /** Carries out the joint request of the ranks; false: the run ends. */
  bool control(const std::uint64_t n);
  /** Adds the wall-clock time since the last call to loop_seconds. */
  void count_time();
  /** Current position of the run. */
  CheckpointPosition position() const;
  void restore();
  void save();
  /** Saves a checkpoint if writing results fails, so that the computation is not lost. */
  void keep_state();
  std::vector<StepObserver *> observers();
  TransientResult advance();
  TransientResult collect();

  const RunParts<dim> parts;
  Stepper &stepper;
  StabilityMonitor monitor;
  DeformationWatch strains;
  RunStatistics<dim> statistics;
  std::unique_ptr<ContactMapOutput<dim>> map; ///< contact map; null without one
  bool warned         = false;                ///< whether large strains were reported
  bool interrupted    = false;
  bool at_limit_cycle = false;
  double loop_seconds = 0.; ///< includes earlier runs
  LargestStrain of_counter; ///< strains of a counter body

  std::chrono::steady_clock::time_point counted; ///< time up to which loop_seconds counts
};
} // namespace mesoslip

#endif
