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
 * Lines "key = value" of whatever decides a bit of the state or of what was written so far, in
 * which a run that is resumed has to agree; @p contents: lines on the files of the body.
 */
std::string run_identity(const Keys &keys,
                         const ContactParameters &parameters,
                         const std::string &contents);

/** What the body of a run is made of besides its material. */
SlidingSetup run_setup(const ContactParameters &parameters,
                       const BodySize &size,
                       const TimeStepChoice &time);

/** The same of a counter body, which is observed in its energies, snapshots and probes alone. */
SlidingSetup setup_below(const ContactParameters &parameters,
                         const BodySize &size,
                         const StepParameters &step,
                         const unsigned int probe_interval);

/** What a run is of, as the kind of the body has it; all of it must outlive the run. */
template <int dim>
struct RunParts
{
  const ContactParameters &parameters; ///< all of them
  const TimeStepChoice &time;          ///< steps
  const BodyScales &scales;            ///< of the body
  const BodySize &size;                ///< of the body
  std::size_t n_cells;                 ///< of all bodies
  PlaceText place;                     ///< of a cell
  SlidingBody<dim> &body;              ///< in its initial state
  ProbeRecorder *probes;               ///< null without any
  SlidingBody<dim> *counter;           ///< below it, on ranks that have it; else null
  ProbeRecorder *probes_below;        ///< of the counter body, likewise; null without any
  CounterOutput<dim> *counter_output; ///< of its snapshots, likewise; null without any
  RunOutput<dim> &output;             ///< dynamics.h5
  TransientCheckpoint &checkpoint;    ///< of the run
  RunContext &context;                ///< of the program
};

/**
 * One run: a body with its boundaries, its observers, everything that changes from step to step,
 * and when it is saved. All ranks call the members.
 */
template <int dim>
class TransientRun
{
public:
  /** From the state of the body on. */
  explicit TransientRun(const RunParts<dim> &parts);

  /**
   * Runs, from the checkpoint on if it is @p continued, until End time, the limit cycle or a
   * request to stop, and writes all results; @p summarize_body is called on rank 0.
   * @throws Interrupted after a checkpoint and what was observed so far have been written
   * @throws NumericalFailure when the run blows up; the last checkpoint stays
   */
  void carry_out(const bool continued, const std::function<void()> &summarize_body);

  /** State between two steps (Boost.Serialization); observers come and go with the keys. */
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
  /** Ends the run if a cell is inside out, and warns once of large strains. */
  void judge(const Deformation &found, const PlaceText &place, const std::uint64_t n);
  /** The same of a counter body. Collective. */
  void judge_counter(const std::uint64_t n);
  /** Does what the ranks want; false: the run ends. */
  bool control(const std::uint64_t n);
  /** Adds the wall-clock time since the last call to loop_seconds. */
  void count_time();
  /** Where the run stands. */
  CheckpointPosition position() const;
  void restore();
  void save();
  /** What was computed is not to be lost with the output. */
  void keep_state();
  std::vector<StepObserver *> observers();
  TransientResult advance();
  TransientResult collect();

  const RunParts<dim> parts;
  Stepper &stepper;
  StabilityMonitor monitor;
  DeformationWatch strains;
  RunStatistics<dim> statistics;
  std::unique_ptr<ContactMapOutput<dim>> map; ///< of the contact; null without one
  bool warned         = false;                ///< of large strains
  bool interrupted    = false;
  bool at_limit_cycle = false;
  double loop_seconds = 0.; ///< in earlier runs, too
  LargestStrain of_counter; ///< the strains of a counter body

  std::chrono::steady_clock::time_point counted; ///< loop_seconds reach up to here
};
} // namespace mesoslip

#endif
