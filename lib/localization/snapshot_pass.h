#ifndef mesoslip_localization_snapshot_pass_h
#define mesoslip_localization_snapshot_pass_h

#include "base/timer.h"
#include "exchange/run_file.h"
#include "localization/stress_statistics.h"

#include <array>
#include <functional>
#include <vector>

namespace mesoslip
{
/** Column and row of a cell. */
using CellIndex = std::array<unsigned int, 2>;

/** What is wanted from the snapshots of a run; null and empty things cost nothing. */
struct SnapshotWork
{
  /** Fed with the strain at the place. */
  StressStatistics *local = nullptr;
  /** Fed with the strain averaged over the body. */
  StressStatistics *uniform = nullptr;
  /** Whether the history of the strain averaged over the body is wanted. */
  bool mean_history = false;
  /** Cells whose strain histories are wanted. */
  std::vector<CellIndex> cells;

  /** Whether anything is wanted. */
  bool any() const
  {
    return local != nullptr || uniform != nullptr || mean_history || !cells.empty();
  }
};

/** What pass_snapshots() returns: one entry a snapshot. */
struct SnapshotHistories
{
  /** s */
  std::vector<double> time;
  /** Strain averaged over the body [k][3]; empty when not wanted. */
  std::vector<double> mean;
  /** Strain [k][3] of each cell wanted. */
  std::vector<std::vector<double>> cells;
};

/** Called with the number of snapshots done so far; may throw to stop. */
using SnapshotCallback = std::function<void(const std::size_t)>;

/**
 * Goes once through the snapshots @p range of a run. They are read some at a time, by a
 * thread of its own while those before are treated; each row of @p target cells is
 * treated for all of them before the next row, so that what belongs to it stays in the
 * cache.
 * @p timer, if any, tells waiting for snapshots from averaging.
 * @throws UserError.
 */
SnapshotHistories pass_snapshots(const RunFile &run,
                                 const IndexRange &range,
                                 const UniformGrid<2> &target,
                                 const SnapshotWork &work,
                                 const SnapshotCallback &callback = {},
                                 Timer *timer                     = nullptr);
} // namespace mesoslip

#endif
