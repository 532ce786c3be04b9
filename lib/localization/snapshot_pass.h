#ifndef mesoslip_localization_snapshot_pass_h
#define mesoslip_localization_snapshot_pass_h

#include "exchange/dynamics_file.h"
#include "localization/stress_statistics.h"

#include <array>
#include <functional>
#include <vector>

namespace mesoslip
{
class Timer;

/** Column and row of a cell. */
using CellIndex = std::array<unsigned int, 2>;

/** What is wanted from the snapshots of a run; null and empty things cost nothing. */
struct SnapshotWork
{
  StressStatistics *local   = nullptr; ///< fed with the strain at the place
  StressStatistics *uniform = nullptr; ///< fed with the strain averaged over the body
  bool mean_history         = false;   ///< history of the strain averaged over the body
  std::vector<CellIndex> cells;        ///< cells whose strain histories are wanted

  /** Whether anything is wanted. */
  bool any() const
  {
    return local != nullptr || uniform != nullptr || mean_history || !cells.empty();
  }
};

/** What pass_snapshots() returns: one entry a snapshot. */
struct SnapshotHistories
{
  std::vector<double> time;               ///< s
  std::vector<double> mean;               ///< strain averaged over the body [k][3]
  std::vector<std::vector<double>> cells; ///< strain [k][3] of each cell wanted
};

/**
 * Goes once through the snapshots @p range of a run. They are read some at a time, by a
 * thread of its own while those before are treated; each row of @p target cells is
 * treated for all of them before the next row, so that what belongs to it stays in the
 * cache. @p done is called with the number of snapshots done so far, and may throw to stop;
 * @p timer, if any, tells waiting for snapshots from averaging.
 * @throws UserError.
 */
SnapshotHistories pass_snapshots(const DynamicsFile &run,
                                 const IndexRange &range,
                                 const UniformGrid<2> &target,
                                 const SnapshotWork &work,
                                 const std::function<void(const std::size_t)> &done,
                                 Timer *timer);
} // namespace mesoslip

#endif
