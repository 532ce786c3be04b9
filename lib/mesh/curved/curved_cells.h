#ifndef mesoslip_mesh_curved_curved_cells_h
#define mesoslip_mesh_curved_curved_cells_h

#include "mesh/mesh.h"

#include <array>

namespace mesoslip
{
/** A node in the middle of a curved edge or face of a cell, or in the middle of the cell. */
template <int dim>
struct CurvedNode
{
  unsigned int cell = 0; ///< index into the cells of the mesh
  unsigned int node = 0; ///< number in deal.II's quadratic cell, corners included
  std::array<double, dim> offset = {}; ///< to the mean of its corners (m)
};

/** Curved nodes of all cells of @p mesh, sorted by cell. */
template <int dim>
std::vector<CurvedNode<dim>> curved_nodes(const Mesh<dim> &mesh);

/** A cell with a curved edge. */
struct CurvedCell
{
  unsigned int cell = 0;  ///< index into the cells of the mesh
  double volume     = 0.; ///< m^3, in 2D m^2
  double least_jacobian =
    0.; ///< smallest determinant of the mapping at a node or quadrature point
};

/** Curved cells of @p mesh. */
template <int dim>
std::vector<CurvedCell> curved_cells(const Mesh<dim> &mesh);

/** Bulge along @p axis (m) of the edges and the middle of the face (2D: edge) with these
 * @p corners. */
template <int dim>
double bulge_of_face(const Mesh<dim> &mesh,
                     const std::vector<unsigned int> &corners,
                     const unsigned int axis);
} // namespace mesoslip

#endif
