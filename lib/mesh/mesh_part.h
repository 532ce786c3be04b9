#ifndef mesoslip_mesh_mesh_part_h
#define mesoslip_mesh_mesh_part_h

#include "mesh/mesh.h"

#include <mpi.h>

#include <utility>

namespace mesoslip
{
/**
 * What one rank holds of a mesh whose cells are divided among the ranks: its cells and
 * all their points. A point of several ranks is owned by the lowest of them. Points that move
 * with another one, see Mesh::originals, are points of their own.
 */
template <int dim>
struct MeshPart
{
  /** Points that this rank shares with another one, in the order of their originals in the
   * whole mesh, which is the same on both; of those that move together one. */
  struct Neighbour
  {
    unsigned int rank = 0;            ///< number of the other one
    std::vector<unsigned int> points; ///< indices into points

    /** Of boost::serialization. */
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &rank &points;
    }
  };

  /** Corners of the cells (m): originals owned by this rank, others that it owns, those of
   * other ranks; each in the order in which the cells need them. */
  std::vector<dealii::Point<dim>> points;

  unsigned int n_distinct = 0; ///< originals that this rank owns, what sums are over
  unsigned int n_owned    = 0; ///< number of points that this rank owns

  /** Along a space-filling curve; vertices are indices into points. */
  std::vector<Cell> cells;

  std::vector<unsigned int> point_in_mesh;    ///< indices of the points in the whole mesh
  std::vector<unsigned int> original_in_mesh; ///< those of their originals
  std::vector<unsigned int> cell_in_mesh;     ///< indices of the cells in the whole mesh

  std::vector<Neighbour> neighbours; ///< in ascending order of their ranks

  /** Points that move with another one of the part, which comes second. */
  std::vector<std::pair<unsigned int, unsigned int>> copies;

  /** Of boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &points &n_distinct &n_owned &cells &point_in_mesh &original_in_mesh;
    archive &cell_in_mesh &neighbours &copies;
  }
};

/** Finds points of the whole mesh among those of a part. */
class PointIndex
{
public:
  /** Of the @p originals in this part, numbers in the whole mesh. */
  template <int dim>
  PointIndex(const MeshPart<dim> &part, const std::vector<unsigned int> &originals);

  /** Those of the part that move as @p original of the whole mesh, the one that the rank
   * counts (see MeshPart::n_distinct) first. */
  std::vector<unsigned int> find(const unsigned int original) const;

  /** Points of the part that move as one before them, and that one; in their order. */
  template <int dim>
  static std::vector<std::pair<unsigned int, unsigned int>>
  copies_in(const MeshPart<dim> &part);

private:
  std::vector<std::pair<unsigned int, unsigned int>> sorted; ///< in mesh, in part
};

/**
 * The rank of each cell by METIS, from the graph of cells that share a face: parts of
 * equal weight with few faces between them. @p weights are those of the cells; empty: all
 * equal.
 */
template <int dim>
std::vector<unsigned int> partition_cells(const Mesh<dim> &mesh,
                                          const unsigned int n_ranks,
                                          const std::vector<unsigned int> &weights = {});

/**
 * Gives each rank its part of the mesh, which rank 0 alone has to have, with the rank of
 * each cell (see partition_cells()). Collective.
 */
template <int dim>
MeshPart<dim> distribute(const Mesh<dim> &mesh,
                         const std::vector<unsigned int> &rank_of_cell,
                         const MPI_Comm communicator);
} // namespace mesoslip

#endif
