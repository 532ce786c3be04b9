#ifndef mesoslip_sliding_counter_counter_output_h
#define mesoslip_sliding_counter_counter_output_h

#include "sliding/counter/counter_motion.h"
#include "sliding/transient/snapshots.h"

#include <string>

namespace mesoslip
{
/** counter_body.h5 and .xdmf: snapshots of the counter body, at the same times as those
 * of the first body. Members are called by the ranks that hold the body. */
template <int dim>
class CounterOutput
{
public:
  /** @p body moves with @p motion; snapshots are taken before @p steps of length @p dt
   * (s). References are kept. */
  CounterOutput(const std::string &path,
                const GivenBody<dim> &body,
                const CounterMotion<dim> &motion,
                const std::vector<std::uint64_t> &steps,
                const double dt,
                Timer &timer);

  /** Reserves the snapshots; the first @p n_done are already in the file of the continued
   * run.
   * @throws UserError if they are missing */
  void begin(const std::uint64_t n_done);

  /** Ends the snapshots. */
  void end();

  /** On rank 0, after end(): completes the file with the @p conditions of the run and the
   * histories of @p probes. */
  void write(const RunConditions &conditions, const std::vector<ProbeHistory> &probes);

  Snapshots<dim> snapshots; ///< displacements of the counter body

private:
  const std::string path;
  const GivenBody<dim> &body;
  const MPI_Comm communicator;
};
} // namespace mesoslip

#endif
