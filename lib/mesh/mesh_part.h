#ifndef mesoslip_mesh_mesh_part_h
#define mesoslip_mesh_mesh_part_h

#include "mesh/mesh.h"

#include <mpi.h>

#include <utility>

namespace mesoslip
{
/**
 * The part of a partitioned mesh on one rank: its cells and all their points. A point
 * shared by several ranks is owned by the lowest of them. Periodic copies, see
 * Mesh::masters, are points of their own.
 */
template <int dim>
struct MeshPart
{
  /** Points shared with a neighbour rank, sorted by the number of their periodic master
   * in the whole mesh, hence in the same order on both ranks; one representative per
   * periodic group. */
  struct Neighbour
  {
    unsigned int rank = 0;            ///< the neighbour rank
    std::vector<unsigned int> points; ///< indices into points

    /** For boost::serialization. */
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &rank &points;
    }
  };

  /** Corners of the cells (m), ordered: locally owned periodic masters, locally owned
   * periodic copies, ghosts; within each group by first use in the cells. */
  std::vector<dealii::Point<dim>> points;

  unsigned int n_distinct = 0; ///< locally owned periodic masters, the points of sums
  unsigned int n_owned    = 0; ///< locally owned points

  /** Sorted along a space-filling curve; vertices are indices into points. */
  std::vector<Cell> cells;

  std::vector<unsigned int> point_in_mesh;  ///< indices of the points in the whole mesh
  std::vector<unsigned int> master_in_mesh; ///< indices of their periodic masters
  std::vector<unsigned int> cell_in_mesh;   ///< indices of the cells in the whole mesh

  std::vector<Neighbour> neighbours; ///< sorted by rank

  /** Pairs (point, first point of its periodic group in this part). */
  std::vector<std::pair<unsigned int, unsigned int>> copies;

  /** For boost::serialization. */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    archive &points &n_distinct &n_owned &cells &point_in_mesh &master_in_mesh;
    archive &cell_in_mesh &neighbours &copies;
  }
};

/** Maps periodic masters of the whole mesh to points of a part. */
class PointIndex
{
public:
  /** @p masters: masters of interest, numbers in the whole mesh. */
  template <int dim>
  PointIndex(const MeshPart<dim> &part, const std::vector<unsigned int> &masters);

  /** Points of the part with the periodic master @p master (number in the whole mesh);
   * the locally owned master (see MeshPart::n_distinct) comes first. */
  std::vector<unsigned int> find(const unsigned int master) const;

  /** Pairs (periodic copy, first point of its group), sorted by point. */
  template <int dim>
  static std::vector<std::pair<unsigned int, unsigned int>>
  copies_in(const MeshPart<dim> &part);

private:
  std::vector<std::pair<unsigned int, unsigned int>> sorted; ///< mesh, part index
};

/**
 * The rank of each cell by METIS, from the graph of cells that share a face: parts of
 * equal weight with few faces between them. @p weights is per cell; empty: all equal.
 */
template <int dim>
std::vector<unsigned int> partition_cells(const Mesh<dim> &mesh,
                                          const unsigned int n_ranks,
                                          const std::vector<unsigned int> &weights = {});

/**
 * Sends each rank its part of the mesh. Only rank 0 needs the mesh and the rank of each
 * cell (see partition_cells()). Collective.
 */
template <int dim>
MeshPart<dim> distribute(const Mesh<dim> &mesh,
                         const std::vector<unsigned int> &rank_of_cell,
                         const MPI_Comm communicator);
} // namespace mesoslip

#endif
