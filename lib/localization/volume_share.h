#ifndef mesoslip_localization_volume_share_h
#define mesoslip_localization_volume_share_h

#include "localization/comparison.h"
#include "localization/localization_input.h"
#include "localization/stress_statistics.h"

#include <limits>
#include <mpi.h>

namespace mesoslip
{
/** The cells of the volume that a rank has, one after the other in the file. */
template <int dim>
struct VolumeShare
{
  std::size_t first_layer = 0;         ///< whole layers of the first axis of fields
  std::size_t first       = 0;         ///< number of the first cell
  std::size_t n_cells     = 0;         ///< number of cells
  std::size_t n_in_row    = 1;         ///< of the rows in which they are treated
  std::vector<std::uint16_t> material; ///< of each cell, see RveFile::constituents()

  /** Of the cells of a mesh that is the body (m), else empty. */
  std::vector<dealii::Point<dim>> middles;

  std::vector<double> measures; ///< of the cells (m^dim); of a grid none: all equal

  /** The place of a cell that another rank has. */
  static constexpr std::size_t elsewhere = std::numeric_limits<std::size_t>::max();

  /** The number among these cells of cell @p cell of the volume, or elsewhere. */
  std::size_t place_of(const std::size_t cell) const
  {
    return cell >= first && cell < first + n_cells ? cell - first : elsewhere;
  }
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
StressMap<dim> plain_map(const LocalizationFiles<dim> &files,
                         const LocalizationParameters &parameters,
                         const VolumeShare<dim> &share);

/** Makes C L of C; the volume mean of L, which is read piece by piece. Collective. @throws
 * UserError */
template <int dim>
VoigtMatrix<dim> multiply_by_concentration(StressMap<dim> &map,
                                           const LocalizationFiles<dim> &files,
                                           const std::string &condition,
                                           const VolumeShare<dim> &share,
                                           const MPI_Comm ranks);

/** Adds to a map that has C L the stress of parameters.heating in a volume that expands freely. Collective. @throws
 * UserError if no phase expands */
template <int dim>
void add_heat(StressMap<dim> &map,
              const LocalizationFiles<dim> &files,
              const LocalizationParameters &parameters,
              const VolumeShare<dim> &share,
              const MPI_Comm ranks);

/** The regions of the cells of this rank in which fields are compared. */
template <int dim>
std::vector<CellRegion> regions_of(const LocalizationFiles<dim> &files,
                                   const LocalizationParameters &parameters,
                                   const VolumeShare<dim> &share);
} // namespace mesoslip

#endif
