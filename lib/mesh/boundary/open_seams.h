#ifndef mesoslip_mesh_boundary_open_seams_h
#define mesoslip_mesh_boundary_open_seams_h

#include "mesh/boundary.h"

namespace mesoslip
{
/**
 * The points of the boundary that lie on one of @p faces of which they are no corner, in ascending
 * order: points that are there twice, and hanging nodes. The body is open there, as it is along a
 * crack. A point lies on a face within a hundredth of the edges of both.
 */
template <int dim>
std::vector<unsigned int> open_seams(const Mesh<dim> &mesh,
                                     const std::vector<BoundaryFace<dim>> &faces);
} // namespace mesoslip

#endif
