#ifndef mesoslip_localization_snapshot_pass_h
#define mesoslip_localization_snapshot_pass_h

#include "localization/localization_program.h"
#include "localization/strain/strain_source.h"
#include "localization/volume_share.h"

#include <vector>

namespace mesoslip
{
/** What is wanted from the snapshots of a run; null and empty things cost nothing. */
template <int dim>
struct SnapshotWork
{
  StressStatistics<dim> *local = nullptr; ///< fed with the strain at the place
  StressStatistics<dim> *uniform =
    nullptr; ///< fed with the strain averaged over the body
  std::vector<StressStatistics<dim>> *points = nullptr; ///< fed with the strain at points
  bool mean = false; ///< history of the strain averaged over the body
  std::vector<std::size_t> followed = {}; ///< cells of the volume with a strain history
};

/** What pass_snapshots() returns: one entry a snapshot, on all ranks. */
struct SnapshotHistories
{
  std::vector<double> mean; ///< strain averaged over the body [k][components]
  std::vector<std::vector<double>>
    cells; ///< strain [k][components] of each cell followed
};

/**
 * Goes once through the @p n_snapshots of @p source; each row of the cells of this rank is treated
 * for all that are at hand before the next row, so that what belongs to it stays in the cache. The
 * monitor tells waiting for snapshots from averaging. Collective. @throws UserError
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
