#ifndef mesoslip_localization_snapshot_pass_h
#define mesoslip_localization_snapshot_pass_h

#include "localization/localization_program.h"
#include "localization/strain/strain_source.h"
#include "localization/volume_share.h"

#include <vector>

namespace mesoslip
{
/** Consumers of the snapshots of a run; null and empty members cost nothing. */
template <int dim>
struct SnapshotWork
{
  StressStatistics<dim> *local = nullptr; ///< gets the local strain
  StressStatistics<dim> *uniform =
    nullptr; ///< gets the strain averaged over the whole body
  std::vector<StressStatistics<dim>> *points = nullptr; ///< get the strain at points
  bool mean = false; ///< whether the history of the body's mean strain is requested
  std::vector<std::size_t> followed = {}; ///< cells of the volume with a strain history
};

/** Result of pass_snapshots(): one entry per snapshot, on all ranks. */
struct SnapshotHistories
{
  std::vector<double> mean; ///< strain averaged over the body [k][components]
  std::vector<std::vector<double>>
    cells; ///< strain [k][components] of each followed cell
};

/**
 * Passes once through the @p n_snapshots of @p source. Each row of the cells of this
 * rank is processed for all snapshots in memory before the next row, so that its data
 * stay in the cache. The monitor separates waiting for snapshots from averaging.
 * Collective.
 * @throws UserError
 */
template <int dim>
SnapshotHistories pass_snapshots(StrainSource<dim> &source,
                                 const VolumeShare<dim> &share,
                                 const SnapshotWork<dim> &work,
                                 const std::size_t n_snapshots,
                                 const LocalizationMonitor &monitor,
                                 const MPI_Comm ranks);
} // namespace mesoslip

#endif
