#ifndef mesoslip_mesh_periodic_points_h
#define mesoslip_mesh_periodic_points_h

#include "mesh/boundary.h"

namespace mesoslip
{
/** Points of the upper side of an axis and the opposite points of the lower side. */
template <int dim>
struct OppositePoints
{
  std::vector<std::array<unsigned int, 2>> pairs; ///< (upper, lower)
  double largest_mismatch = 0.;                   ///< distance along the sides (m)
};

/**
 * Pairs the points of two opposite sides by nearest distance.
 * @throws UserError unless the sides have equally many points, each opposite to another
 * within Mesh::tolerance times @p cell_size (m), the shortest edge of the mesh, and the
 * pairs map faces to faces
 */
template <int dim>
OppositePoints<dim> opposite_points(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &lower,
                                    const std::vector<BoundaryFace<dim>> &upper,
                                    const unsigned int axis,
                                    const double cell_size);
/**
 * Makes the mesh periodic along @p axis: the opposite point of @p lower becomes the
 * periodic master of each point of @p upper (see Mesh::masters); in 3D this includes
 * edges that are joined along both axes.
 * @return the pairs
 * @throws UserError as opposite_points(), or unless all pairs are equally far apart
 */
template <int dim>
OppositePoints<dim> join_sides(Mesh<dim> &mesh,
                               const std::vector<BoundaryFace<dim>> &lower,
                               const std::vector<BoundaryFace<dim>> &upper,
                               const unsigned int axis,
                               const double cell_size);
} // namespace mesoslip

#endif
