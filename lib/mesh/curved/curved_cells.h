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
  unsigned int node = 0; ///< of the quadratic cell of deal.II, corners included
  std::array<double, dim> offset = {}; ///< from the mean of the corners around it (m)
};

/** Those of all cells of @p mesh, cell after cell. */
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

/** Those of @p mesh. */
template <int dim>
std::vector<CurvedCell> curved_cells(const Mesh<dim> &mesh);

/** How far the edges of the face (2D: edge) with these @p corners and its middle bulge along @p axis (m). */
template <int dim>
double bulge_of_face(const Mesh<dim> &mesh,
                     const std::vector<unsigned int> &corners,
                     const unsigned int axis);
} // namespace mesoslip

#endif
