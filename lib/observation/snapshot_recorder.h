#ifndef mesoslip_observation_snapshot_recorder_h
#define mesoslip_observation_snapshot_recorder_h

#include "dynamics/stepper.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <functional>
#include <mpi.h>
#include <vector>

namespace mesoslip
{
/** Hands the whole displacement field to a writer on rank 0 at equal times of a window.
 */
class SnapshotRecorder : public StepObserver
{
public:
  /** Receives the gathered field; called on rank 0 only, once for each of times(). */
  using Writer = std::function<void(const NodalField<double> &)>;

  /** Steps nearest to from, from + interval, ... up to to (s); every step if interval <
   * dt. */
  SnapshotRecorder(const double from,
                   const double to,
                   const double interval,
                   const double dt,
                   const NodalField<double> &u,
                   const NodeRows &rows,
                   const MPI_Comm communicator,
                   const Writer &writer);

  std::uint64_t next_step(const std::uint64_t n) const override;
  void before_step(const std::uint64_t n) override;
  void after_step(const std::uint64_t) override
  {
  }

  /** Of all snapshots of the run, those to come as well (s). */
  std::vector<double> times() const;

private:
  std::vector<std::uint64_t> steps;
  const double dt;
  const NodalField<double> &u;
  const NodeRows rows;
  const MPI_Comm communicator;
  const Writer writer;
};
} // namespace mesoslip

#endif
