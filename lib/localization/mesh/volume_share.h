#ifndef mesoslip_localization_mesh_volume_share_h
#define mesoslip_localization_mesh_volume_share_h

#include "localization/mesh/cell_statistics.h"
#include "localization/mesh/mesh_input.h"

#include <mpi.h>

namespace mesoslip
{
/** The cells of the volume that a rank has, one after the other in the file. */
template <int dim>
struct VolumeShare
{
  std::size_t first_row = 0;           ///< whole rows of the first axis of fields
  std::size_t first     = 0;           ///< number of the first cell
  std::size_t n_cells   = 0;           ///< number of cells
  std::vector<std::uint16_t> material; ///< of each cell, see RveFile::constituents()
  std::vector<dealii::Point<dim>>
    middles;                       ///< of the cells, if the volume is the body (m)
  std::vector<double> measures;    ///< of the cells (m^dim); of a grid none: all equal
  std::vector<std::size_t> probes; ///< their cells among these, see StressRecord
};

/** The share of this rank; @p of_root are the cells of the volume on rank 0. Collective. @throws
 * UserError */
template <int dim>
VolumeShare<dim> make_share(const LocalizationFiles<dim> &files,
                            const LocalizationPlan<dim> &plan,
                            const CellSet<dim> &of_root,
                            const MPI_Comm ranks);

/** C of each cell, and the ratios that are asked for. */
template <int dim>
LocalCells<dim> plain_cells(const LocalizationFiles<dim> &files,
                            const LocalizationParameters &parameters,
                            const VolumeShare<dim> &share);

/** Makes C L of C; the volume mean of L, which is read piece by piece. Collective. @throws
 * UserError */
template <int dim>
VoigtMatrix<dim> multiply_by_concentration(LocalCells<dim> &cells,
                                           const LocalizationFiles<dim> &files,
                                           const std::string &condition,
                                           const VolumeShare<dim> &share,
                                           const MPI_Comm ranks);
} // namespace mesoslip

#endif
