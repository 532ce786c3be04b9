#ifndef mesoslip_localization_mesh_strain_source_h
#define mesoslip_localization_mesh_strain_source_h

#include "exchange/body_snapshots.h"
#include "localization/mesh/cell_strain.h"
#include "mesh/point_blocks.h"

#include <memory>
#include <mpi.h>
#include <string>

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
 * body. Each rank reads a block of the points of each snapshot, and gets what is around its places.
 */
template <int dim>
class StrainSource
{
public:
  /** @p path is the file of the run, @p of_root its mesh on rank 0; @p given are the places of this
   * rank. Collective. @throws UserError */
  StrainSource(const std::string &path,
               const Mesh<dim> &of_root,
               const PlacesInCells<dim> &given,
               const MPI_Comm the_communicator);

  /** Reads snapshot number @p k and evaluates it. Collective. @throws UserError */
  void set_snapshot(const std::size_t k);

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
  std::vector<unsigned int> distribute_cells(const Mesh<dim> &of_root,
                                             const PlacesInCells<dim> &given);
  void distribute_mean(const Mesh<dim> &of_root);

  const MPI_Comm communicator;
  const BodySnapshots<dim> run;
  std::vector<dealii::Point<dim>> places;
  std::vector<std::size_t> wanted_cell; ///< place among those of CellStrain
  std::unique_ptr<CellStrain<dim>> strain;
  const std::array<std::size_t, 2>
    rows;                         ///< in which the file has the points: number, length
  const NumbersFromBlocks points; ///< those around the places
  MeanStrain<dim> mean_of_block;  ///< what the points that this rank reads add
  VoigtVector<dim> mean_strain = VoigtVector<dim>::Zero();
};
} // namespace mesoslip

#endif
