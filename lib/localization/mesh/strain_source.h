#ifndef mesoslip_localization_mesh_strain_source_h
#define mesoslip_localization_mesh_strain_source_h

#include "exchange/body_snapshots.h"
#include "material/voigt.h"

#include <memory>
#include <mpi.h>

namespace mesoslip
{
/** Where the strain of a run is wanted. */
template <int dim>
struct StrainPlaces
{
  const std::vector<dealii::Point<dim>> &middles; ///< of the cells of this rank (m)
  const std::vector<dealii::Point<dim>> points;   ///< the same on all ranks (m)
  const bool mean; ///< whether that over the body is wanted

  /** Place number @p k, the points behind the middles. */
  const dealii::Point<dim> &operator[](const std::size_t k) const
  {
    return k < middles.size() ? middles[k] : points[k - middles.size()];
  }

  /** Number of places. */
  std::size_t size() const
  {
    return middles.size() + points.size();
  }
};

/** The strain of a run at some places. */
template <int dim>
class StrainSource
{
public:
  virtual ~StrainSource() = default;

  /** Reads snapshot number @p k of the run and evaluates it. Collective. @throws UserError */
  virtual void set_snapshot(const std::size_t k) = 0;

  /** At place number @p k. */
  virtual VoigtVector<dim> at(const std::size_t k) const = 0;

  /** Over the body, if it is wanted. */
  const VoigtVector<dim> &mean() const
  {
    return mean_strain;
  }

protected:
  VoigtVector<dim> mean_strain = VoigtVector<dim>::Zero(); ///< over the body
};

/** Of a body on a grid: each rank reads the nodes around its places. Collective. */
template <int dim>
std::unique_ptr<StrainSource<dim>> make_grid_source(const BodySnapshots<dim> &run,
                                                    const StrainPlaces<dim> &places,
                                                    const MPI_Comm communicator);

/**
 * Of a body on a mesh, whose cells @p cell hold the places of this rank. Rank 0, where the whole mesh
 * is @p of_root, gives each rank the cells around its places; of each snapshot a rank reads a block
 * of the points, and gets those that it needs from the others. Collective.
 */
template <int dim>
std::unique_ptr<StrainSource<dim>> make_mesh_source(const BodySnapshots<dim> &run,
                                                    const Mesh<dim> &of_root,
                                                    const StrainPlaces<dim> &places,
                                                    const std::vector<unsigned int> &cell,
                                                    const MPI_Comm communicator);
} // namespace mesoslip

#endif
