#ifndef mesoslip_sliding_counter_counter_output_h
#define mesoslip_sliding_counter_counter_output_h

#include "sliding/counter/counter_motion.h"
#include "sliding/transient/snapshots.h"

#include <string>

namespace mesoslip
{
/** counter_body.h5 and .xdmf: snapshots of the second body at the times of those of the first one. Members are called by the
 * ranks that have the body. */
template <int dim>
class CounterOutput
{
public:
  /** Of the @p body in @p motion, before these @p steps of length @p dt (s); references are kept. */
  CounterOutput(const std::string &path,
                const GivenBody<dim> &body,
                const CounterMotion<dim> &motion,
                const std::vector<std::uint64_t> &steps,
                const double dt,
                Timer &timer);

  /** Makes place for snapshots, of which the first @p n_done are in the file of the run that is continued. @throws UserError
   * if they are not */
  void begin(const std::uint64_t n_done);

  /** There are no more snapshots. */
  void end();

  /** On rank 0, after end(): completes the file with the @p conditions of the run and what @p probes saw. */
  void write(const RunConditions &conditions, const std::vector<ProbeHistory> &probes);

  Snapshots<dim> snapshots; ///< displacements of the second body

private:
  const std::string path;
  const GivenBody<dim> &body;
  const MPI_Comm communicator;
};
} // namespace mesoslip

#endif
