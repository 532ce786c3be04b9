#ifndef mesoslip_mesh_boundary_open_seams_h
#define mesoslip_mesh_boundary_open_seams_h

#include "mesh/boundary.h"

namespace mesoslip
{
/**
 * Boundary points on one of @p faces of which they are not a corner, in ascending order:
 * duplicated points and hanging nodes. The body is open there, as along a crack. The
 * tolerance is a hundredth of the edges of both faces.
 */
template <int dim>
std::vector<unsigned int> open_seams(const Mesh<dim> &mesh,
                                     const std::vector<BoundaryFace<dim>> &faces);
} // namespace mesoslip

#endif
