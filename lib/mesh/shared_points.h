#ifndef mesoslip_mesh_shared_points_h
#define mesoslip_mesh_shared_points_h

#include "mesh/mesh_part.h"

namespace mesoslip
{
/**
 * Sums nodal fields over the ranks that share a point, and over periodic groups. All
 * ranks of a point add the same numbers in rank order, so the results agree bit by bit
 * and need no further message.
 */
template <int dim>
class SharedPoints
{
public:
  /** For fields with @p stride numbers per point of @p part, of which the first dim are
   * summed. */
  SharedPoints(const MeshPart<dim> &part,
               const unsigned int stride,
               const MPI_Comm communicator);

  /** Waits for pending messages. */
  ~SharedPoints();

  SharedPoints(const SharedPoints &)            = delete; ///< requests refer to members
  SharedPoints &operator=(const SharedPoints &) = delete; ///< see the constructor

  /** Starts sending local contributions; contributions of a periodic group are summed at
   * one of its points first. */
  void start(double *field);

  /** Waits for the contributions of the neighbours and replaces local contributions by
   * the sums. */
  void finish(double *field);

private:
  const std::vector<typename MeshPart<dim>::Neighbour> neighbours;
  const std::vector<std::pair<unsigned int, unsigned int>> copies; ///< MeshPart::copies
  const unsigned int stride;
  const MPI_Comm communicator;
  unsigned int rank = 0;
  std::vector<unsigned int> points;      ///< points shared with any neighbour, each once
  std::vector<double> own;               ///< local contributions at these points
  std::vector<std::vector<double>> sent; ///< send buffer per neighbour
  std::vector<std::vector<double>> received;
  std::vector<MPI_Request> sending, receiving;
};
} // namespace mesoslip

#endif
