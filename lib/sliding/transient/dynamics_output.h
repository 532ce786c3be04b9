#ifndef mesoslip_sliding_transient_dynamics_output_h
#define mesoslip_sliding_transient_dynamics_output_h

#include "dynamics/stepper.h"
#include "exchange/dynamics_file.h"
#include "sliding/transient/contact_map_output.h"
#include "sliding/transient/transient_result.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace mesoslip
{
/**
 * dynamics.h5 of a run with its companions dynamics.xdmf (snapshots), history.csv and
 * energy.csv. Snapshots are observed and written to dynamics.h5.part as the run goes on,
 * everything else at its end. Rank 0 writes.
 */
class DynamicsOutput : public StepObserver
{
public:
  /** Snapshots of @p time are those that @p parameters ask for; references are kept. */
  DynamicsOutput(RunContext &context,
                 const ContactParameters &parameters,
                 const BodyDescription &body,
                 const TimeStepChoice &time);

  /** Whether the run has snapshots. */
  bool has_snapshots() const
  {
    return !steps.empty();
  }

  /**
   * Makes place for the snapshots of @p of_stepper, of which the first @p n_done are in the
   * file already, of the run that is continued, and for @p map (may be null). Collective.
   * @throws UserError if they are not
   */
  void
  begin(const Stepper &of_stepper, const std::uint64_t n_done, ContactMapOutput<2> *map);

  std::uint64_t next_step(const std::uint64_t n) const override;

  /** Writes the displacement as the next snapshot. */
  void before_step(const std::uint64_t n) override;

  /** Waits until the snapshots are on the disk; returns their number. On rank 0. */
  std::uint64_t save_snapshots();

  /** Writes dynamics.h5 and its companions, replacing older ones; @p map may be null. On
   * rank 0. */
  void write(const TransientResult &run, const ContactMapOutput<2> *map);

private:
  RunContext &context;
  const BodyDescription &body;
  const TimeStepChoice &time;
  std::optional<DynamicsFile> file;
  std::vector<std::uint64_t> steps;  ///< of all snapshots, those to come as well
  const Stepper *stepper  = nullptr; ///< whose snapshots they are
  std::size_t n_snapshots = 0;       ///< written so far
};
} // namespace mesoslip

#endif
