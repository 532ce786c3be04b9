#ifndef mesoslip_sliding_transient_run_output_h
#define mesoslip_sliding_transient_run_output_h

#include "dynamics/stepper.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/run_needs.h"
#include "sliding/transient/transient_result.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace mesoslip
{
/**
 * dynamics.h5 of a run with its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. Snapshots are observed and written to dynamics.h5.part as the run goes on,
 * everything else at its end. How the body and its fields are written is for derived classes to
 * say. Members are called by all ranks unless said otherwise.
 */
template <int dim>
class RunOutput : public StepObserver
{
public:
  /** Whether the run has snapshots. */
  bool has_snapshots() const
  {
    return !steps.empty();
  }

  /** Snapshots written so far. */
  std::uint64_t n_snapshots() const
  {
    return n_written;
  }

  /**
   * Makes place for the snapshots of @p of_stepper, of which the first @p n_done are in the
   * file already, of the run that is continued, and for @p map (may be null).
   * @throws UserError if they are not
   */
  virtual void begin(const Stepper &of_stepper,
                     const std::uint64_t n_done,
                     ContactMapOutput<dim> *map) = 0;

  /** The first step >= @p n before which a snapshot is taken. */
  std::uint64_t next_step(const std::uint64_t n) const override
  {
    const auto next = std::lower_bound(steps.begin(), steps.end(), n);
    return next == steps.end() ? std::numeric_limits<std::uint64_t>::max() : *next;
  }

  /** Waits until the snapshots are on the disk. */
  virtual void sync() = 0;

  /** There are no more snapshots. */
  virtual void end()
  {
  }

  /** On rank 0, after end(): writes everything else, once, replacing what was there; @p map may
   * be null. */
  virtual void write(const TransientResult &run, const ContactMapOutput<dim> *map) = 0;

protected:
  /** Snapshots are those that @p parameters ask for; references are kept. */
  RunOutput(RunContext &context,
            const ContactParameters &parameters,
            const TimeStepChoice &time)
    : context(context)
    , time(time)
    , steps(snapshot_steps(parameters, time))
  {
  }

  /** Of the snapshots that were written (s). */
  std::vector<double> snapshot_times() const
  {
    std::vector<double> times;
    for (std::size_t k = 0; k < n_written; ++k)
      times.push_back(static_cast<double>(steps[k]) * time.step.dt);
    return times;
  }

  RunContext &context;                    ///< of the run
  const TimeStepChoice &time;             ///< of the run
  const std::vector<std::uint64_t> steps; ///< of all snapshots, those to come as well
  const Stepper *stepper  = nullptr;      ///< whose snapshots they are
  std::uint64_t n_written = 0;            ///< see n_snapshots()
};
} // namespace mesoslip

#endif
