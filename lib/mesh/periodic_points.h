#ifndef mesoslip_mesh_periodic_points_h
#define mesoslip_mesh_periodic_points_h

#include "mesh/boundary.h"

namespace mesoslip
{
/** Points of the upper side of an axis and those opposite on the lower side. */
template <int dim>
struct OppositePoints
{
  std::vector<std::array<unsigned int, 2>> pairs; ///< upper and lower
  double largest_mismatch = 0.;                   ///< along the sides (m)
};

/**
 * Pairs the points of two opposite sides, for each point the nearest one.
 * @throws UserError unless the sides have equally many points, each is opposite to one within
 * Mesh::tolerance times @p cell_size (m), the shortest edge of the mesh, and the pairs make faces
 * of faces
 */
template <int dim>
OppositePoints<dim> opposite_points(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &lower,
                                    const std::vector<BoundaryFace<dim>> &upper,
                                    const unsigned int axis,
                                    const double cell_size);
/**
 * Makes the mesh periodic along @p axis: each point of @p upper moves as that of @p lower
 * does which is opposite (see Mesh::originals), in 3D also along edges that are joined
 * along both axes.
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
