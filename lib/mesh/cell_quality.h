#ifndef mesoslip_mesh_cell_quality_h
#define mesoslip_mesh_cell_quality_h

#include "mesh/mesh.h"

namespace mesoslip
{
/** How well the cells of a mesh are shaped, and how large they are. */
template <int dim>
struct MeshQuality
{
  /** Smallest scaled Jacobian: determinant of the edges at a corner of a cell, each of
   * length one. 1 for right angles, sqrt(3)/2 for an equilateral triangle, 0 for a flat
   * corner. */
  double worst_jacobian = 1.;

  dealii::Point<dim> worst_place; ///< middle of that cell (m)
  double smallest_edge = 0.;      ///< of all cells (m)
  double largest_edge  = 0.;      ///< of all cells (m)

  /** Area (2D, m^2) or volume (m^3) of each phase, for each phase of the mesh. */
  std::vector<double> volume;

  std::vector<std::size_t> n_cells; ///< of each phase of the mesh
};

/** Area (2D, m^2) or volume (m^3) of the cell with the corners @p vertices, negative if these run the
 * other way round; far from the origin as near. */
template <int dim>
double cell_volume(const std::vector<dealii::Point<dim>> &points,
                   const std::vector<unsigned int> &vertices);

/**
 * Looks at the cells of a mesh. @throws UserError if a corner of one is flat or inside
 * out: then the cell is twisted or concave, and shape functions have no gradient somewhere
 * in it; or if it lies so far from the origin that coordinates do not tell its corners apart.
 */
template <int dim>
MeshQuality<dim> cell_quality(const Mesh<dim> &mesh);
} // namespace mesoslip

#endif
