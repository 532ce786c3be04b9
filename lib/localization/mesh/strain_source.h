#ifndef mesoslip_localization_mesh_strain_source_h
#define mesoslip_localization_mesh_strain_source_h

#include "localization/mesh/cell_strain.h"

#include <memory>
#include <mpi.h>

namespace mesoslip
{
/** Places and the cells of a body that hold them. */
template <int dim>
struct PlacesInCells
{
  std::vector<dealii::Point<dim>> at; ///< m
  std::vector<unsigned int> cell;     ///< of each place

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &at &cell;
  }
};

/**
 * The strain of a run at some places, different ones on each rank, and its mean over the
 * body, from snapshots that rank 0 has. Of the body each rank gets what is around its places.
 */
template <int dim>
class StrainSource
{
public:
  /** @p of_root is the mesh of the run on rank 0; @p given are those of this rank.
   * Collective. */
  StrainSource(const Mesh<dim> &of_root,
               const PlacesInCells<dim> &given,
               const MPI_Comm the_communicator);

  /** Evaluates the displacement @p u of all points on rank 0. Collective. */
  void set_displacement(const std::vector<double> &u);

  /** At place number @p k of this rank. */
  VoigtVector<dim> at(const std::size_t k) const
  {
    return strain->at(wanted_cell[k], places[k]);
  }

  /** Over the body. */
  const VoigtVector<dim> &mean() const
  {
    return mean_strain;
  }

private:
  const MPI_Comm communicator;
  std::vector<dealii::Point<dim>> places;
  std::vector<std::size_t> wanted_cell; ///< place among those of CellStrain

  /** On rank 0: the points of the body that each rank needs the displacement of. */
  std::vector<std::vector<unsigned int>> points_of_rank;
  std::vector<double> displacement; ///< of those of this rank, [point][dim]
  std::unique_ptr<CellStrain<dim>> strain;
  std::unique_ptr<MeanStrain<dim>> mean_of_body; ///< on rank 0
  VoigtVector<dim> mean_strain = VoigtVector<dim>::Zero();
};
} // namespace mesoslip

#endif
