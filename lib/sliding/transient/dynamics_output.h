#ifndef mesoslip_sliding_transient_dynamics_output_h
#define mesoslip_sliding_transient_dynamics_output_h

#include "exchange/dynamics_file.h"
#include "sliding/transient/run_output.h"

#include <cstdint>
#include <optional>

namespace mesoslip
{
/** Of a plane grid, whose whole fields rank 0 writes. */
class DynamicsOutput : public RunOutput<2>
{
public:
  /** References are kept. */
  DynamicsOutput(RunContext &context,
                 const ContactParameters &parameters,
                 const BodyDescription &body,
                 const TimeStepChoice &time);

  /** Rank 0 creates dynamics.h5, or goes on with it, with place for @p map; see RunOutput. */
  void begin(const Stepper &of_stepper,
             const std::uint64_t n_done,
             ContactMapOutput<2> *map) override;
  void before_step(const std::uint64_t n) override;
  void sync() override;

  /** On rank 0: contact nodes, series and tables, and the times of the snapshots; see RunOutput. */
  void write(const TransientResult &run, const ContactMapOutput<2> *map) override;

private:
  const BodyDescription &body;
  std::optional<DynamicsFile> file; ///< on rank 0
};
} // namespace mesoslip

#endif
