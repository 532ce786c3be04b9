#ifndef mesoslip_localization_strain_strain_source_h
#define mesoslip_localization_strain_strain_source_h

#include "exchange/body_snapshots.h"
#include "localization/cell_rows.h"
#include "material/voigt.h"

#include <memory>
#include <mpi.h>

namespace mesoslip
{
/** Places and times at which the strain of a run is requested. */
template <int dim>
struct StrainPlaces
{
  std::size_t n_cells  = 0; ///< cells of the volume on this rank, in rows as in CellRows
  std::size_t n_in_row = 1; ///< cells per row

  /** The volume, if it is a grid; this rank has whole layers along the last axis. */
  const UniformGrid<dim> *grid = nullptr;

  /** First layer of this rank. */
  std::size_t first_layer = 0;

  /** Centroids of the cells of this rank (m); not needed if volume and body are grids. */
  std::vector<dealii::Point<dim>> middles = {};

  std::vector<dealii::Point<dim>> points = {};    ///< the same on all ranks (m)
  bool mean                              = false; ///< whether the mean is requested
  IndexRange snapshots;                           ///< snapshots of the run
};

/** The strain of a run at the requested places, a batch of snapshots at a time. */
template <int dim>
class StrainSource
{
public:
  virtual ~StrainSource() = default;

  /** Advances to the next batch of snapshots.
   * @return their number, 0 after the last one. Collective.
   * @throws UserError */
  virtual std::size_t next() = 0;

  /** Strain of row @p j of the cells in snapshot @p b of the batch; valid until the next
   * call. */
  virtual CellRow row(const std::size_t b, const std::size_t j) = 0;

  /** Strain at point @p p in snapshot @p b of the batch. */
  virtual VoigtVector<dim> at_point(const std::size_t b, const std::size_t p) const = 0;

  /** Mean strain of the body in snapshot @p b of the batch, if requested. */
  virtual const VoigtVector<dim> &mean(const std::size_t b) const = 0;
};

/** A row of strains that is filled cell by cell. */
template <int dim>
class StrainRowBuffer
{
public:
  /** At most @p n_in_row cells. */
  explicit StrainRowBuffer(const std::size_t n_in_row)
    : values(n_in_row, n_in_row, n_voigt<dim>)
  {
  }

  /** The row of @p n cells with the strains @p strain (i). */
  template <typename Strain>
  CellRow fill(const std::size_t n, const Strain &strain)
  {
    for (std::size_t i = 0; i < n; ++i)
      {
        const VoigtVector<dim> of_cell = strain(i);
        for (unsigned int c = 0; c < n_voigt<dim>; ++c)
          values.array(c, 0)[i] = of_cell[c];
      }
    return {values.array(0, 0), values.stride()};
  }

private:
  CellRows values; ///< buffer of a row
};

/** Source for a body on a grid: each rank reads the nodes around its places. @p run and
 * @p places must outlive it. Collective. */
template <int dim>
std::unique_ptr<StrainSource<dim>> make_grid_source(const BodySnapshots<dim> &run,
                                                    const StrainPlaces<dim> &places,
                                                    const MPI_Comm communicator);

/** Memory of a rank for displacements of a grid (bytes), if its places take
 * @p of_snapshot bytes in each of @p n_snapshots. */
double bytes_of_displacements(const double of_snapshot, const std::size_t n_snapshots);

/**
 * Source for a body on a mesh; the cells @p cell hold the centroids and points of this
 * rank. Rank 0 has the whole mesh @p of_root and sends each rank the cells around its
 * places. Of each snapshot a rank reads a block of points; needed values are exchanged.
 * @p run and @p places must outlive it. Collective.
 */
template <int dim>
std::unique_ptr<StrainSource<dim>> make_mesh_source(const BodySnapshots<dim> &run,
                                                    const Mesh<dim> &of_root,
                                                    const StrainPlaces<dim> &places,
                                                    const std::vector<unsigned int> &cell,
                                                    const MPI_Comm communicator);
} // namespace mesoslip

#endif
