#ifndef mesoslip_localization_volume_share_h
#define mesoslip_localization_volume_share_h

#include "localization/comparison.h"
#include "localization/localization_input.h"
#include "localization/stress_statistics.h"

#include <limits>
#include <mpi.h>

namespace mesoslip
{
/** The cells of the volume on one rank, contiguous in the file. */
template <int dim>
struct VolumeShare
{
  std::size_t first_layer = 0;         ///< first layer along the first axis of fields
  std::size_t first       = 0;         ///< number of the first cell
  std::size_t n_cells     = 0;         ///< number of cells
  std::size_t n_in_row    = 1;         ///< cells per row of CellRows
  std::vector<std::uint16_t> material; ///< per cell, see RveFile::constituents()

  /** Centroids of the cells if a mesh is the body (m), else empty. */
  std::vector<dealii::Point<dim>> middles;

  std::vector<double> measures; ///< sizes of cells (m^dim); empty for a grid

  /** Returned by place_of() for a cell of another rank. */
  static constexpr std::size_t elsewhere = std::numeric_limits<std::size_t>::max();

  /** Local number of cell @p cell of the volume, or elsewhere. */
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

/** Map with C of each cell and the requested ratios. */
template <int dim>
StressMap<dim> plain_map(const LocalizationFiles<dim> &files,
                         const LocalizationParameters &parameters,
                         const VolumeShare<dim> &share);

/** Multiplies the map by L: C becomes C L.
 * @return the volume mean of L, which is read in pieces. Collective.
 * @throws UserError */
template <int dim>
VoigtMatrix<dim> multiply_by_concentration(StressMap<dim> &map,
                                           const LocalizationFiles<dim> &files,
                                           const std::string &condition,
                                           const VolumeShare<dim> &share,
                                           const MPI_Comm ranks);

/** Adds the stress of parameters.heating in a freely expanding volume to a map that has C
 * L. Collective.
 * @throws UserError if no phase expands */
template <int dim>
void add_heat(StressMap<dim> &map,
              const LocalizationFiles<dim> &files,
              const LocalizationParameters &parameters,
              const VolumeShare<dim> &share,
              const MPI_Comm ranks);

/** Regions of this rank's cells for the comparison of fields. */
template <int dim>
std::vector<CellRegion> regions_of(const LocalizationFiles<dim> &files,
                                   const LocalizationParameters &parameters,
                                   const VolumeShare<dim> &share);
} // namespace mesoslip

#endif
