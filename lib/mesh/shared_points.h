#ifndef mesoslip_mesh_shared_points_h
#define mesoslip_mesh_shared_points_h

#include "mesh/mesh_part.h"

namespace mesoslip
{
/**
 * Sums over the ranks at the points that they share, and over points that move together. All ranks of a point add up the same
 * numbers in the same order, that of the ranks, and so get the same bits: what they compute
 * from them needs no message.
 */
template <int dim>
class SharedPoints
{
public:
  /** For fields with @p stride numbers a point of @p part, of which the first dim are
   * summed. */
  SharedPoints(const MeshPart<dim> &part,
               const unsigned int stride,
               const MPI_Comm communicator);

  /** Waits for what is under way. */
  ~SharedPoints();

  SharedPoints(const SharedPoints &)            = delete; ///< requests refer to members
  SharedPoints &operator=(const SharedPoints &) = delete; ///< see the constructor

  /** Sends the terms of this rank, of which those of points that move together are added up
   * at one of them. */
  void start(double *field);

  /** Replaces the terms of this rank by the sums, once those of the others are there. */
  void finish(double *field);

private:
  const std::vector<typename MeshPart<dim>::Neighbour> neighbours;
  const std::vector<std::pair<unsigned int, unsigned int>> copies; ///< of MeshPart
  const unsigned int stride;
  const MPI_Comm communicator;
  unsigned int rank = 0;
  std::vector<unsigned int> points;      ///< of all neighbours, each once
  std::vector<double> own;               ///< terms of this rank at these points
  std::vector<std::vector<double>> sent; ///< to each neighbour
  std::vector<std::vector<double>> received;
  std::vector<MPI_Request> sending, receiving;
};
} // namespace mesoslip

#endif
