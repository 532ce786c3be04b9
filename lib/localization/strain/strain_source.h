#ifndef mesoslip_localization_strain_strain_source_h
#define mesoslip_localization_strain_strain_source_h

#include "exchange/body_snapshots.h"
#include "localization/cell_rows.h"
#include "material/voigt.h"

#include <memory>
#include <mpi.h>

namespace mesoslip
{
/** Where the strain of a run is wanted, and when. */
template <int dim>
struct StrainPlaces
{
  std::size_t n_cells  = 0; ///< of the volume on this rank, in rows as in CellRows
  std::size_t n_in_row = 1; ///< cells of a row

  /** The volume, if it is a grid of which this rank has whole layers along the last axis. */
  const UniformGrid<dim> *grid = nullptr;

  /** The first of these layers. */
  std::size_t first_layer = 0;

  /** Middles of the cells of this rank (m); not needed of a grid in a body on a grid. */
  std::vector<dealii::Point<dim>> middles = {};

  std::vector<dealii::Point<dim>> points = {}; ///< the same on all ranks (m)
  bool mean = false;                           ///< whether that over the body is wanted
  IndexRange snapshots;                        ///< of the run
};

/** The strain of a run at some places, for some snapshots at a time. */
template <int dim>
class StrainSource
{
public:
  virtual ~StrainSource() = default;

  /** Goes on to the next snapshots; their number, 0 behind the last one. Collective. @throws
   * UserError */
  virtual std::size_t next() = 0;

  /** Strain of row @p j of the cells in number @p b of these snapshots; until the next call. */
  virtual CellRow row(const std::size_t b, const std::size_t j) = 0;

  /** Strain at point number @p p in number @p b of these snapshots. */
  virtual VoigtVector<dim> at_point(const std::size_t b, const std::size_t p) const = 0;

  /** Strain over the body in number @p b of these snapshots, if it is wanted. */
  virtual const VoigtVector<dim> &mean(const std::size_t b) const = 0;
};

/** A row of strains that are found cell by cell. */
template <int dim>
class StrainRowBuffer
{
public:
  /** Of @p n_in_row cells at most. */
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
  CellRows values; ///< one row
};

/** Of a body on a grid: each rank reads the nodes around its places. @p run and @p places have to
 * outlive it. Collective. */
template <int dim>
std::unique_ptr<StrainSource<dim>> make_grid_source(const BodySnapshots<dim> &run,
                                                    const StrainPlaces<dim> &places,
                                                    const MPI_Comm communicator);

/** Bytes of the displacements of a grid that a rank has in memory, if those of its places take @p
 * of_snapshot bytes in each of @p n_snapshots. */
double bytes_of_displacements(const double of_snapshot, const std::size_t n_snapshots);

/**
 * Of a body on a mesh, whose cells @p cell hold the middles and points of this rank. Rank 0, where
 * the whole mesh is @p of_root, gives each rank the cells around its places; of each snapshot a rank reads a
 * block of the points, and gets those that it needs from the others. @p run and @p places have to
 * outlive it. Collective.
 */
template <int dim>
std::unique_ptr<StrainSource<dim>> make_mesh_source(const BodySnapshots<dim> &run,
                                                    const Mesh<dim> &of_root,
                                                    const StrainPlaces<dim> &places,
                                                    const std::vector<unsigned int> &cell,
                                                    const MPI_Comm communicator);
} // namespace mesoslip

#endif
