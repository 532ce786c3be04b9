#ifndef mesoslip_mesh_cell_quality_h
#define mesoslip_mesh_cell_quality_h

#include "mesh/mesh.h"

namespace mesoslip
{
/** Shape quality and size of the cells of a mesh. */
template <int dim>
struct MeshQuality
{
  /** Smallest scaled Jacobian: determinant of the normalized edges at a corner of a cell.
   * 1 for right angles, sqrt(3)/2 for an equilateral triangle, 0 for a flat corner. */
  double worst_jacobian = 1.;

  dealii::Point<dim> worst_place; ///< centre of that cell (m)
  double smallest_edge = 0.;      ///< over all cells (m)
  double largest_edge  = 0.;      ///< over all cells (m)

  /** Area (2D, m^2) or volume (m^3) of each phase, for each phase of the mesh. */
  std::vector<double> volume;

  std::vector<std::size_t> n_cells; ///< per phase of the mesh
};

/** Area (2D, m^2) or volume (m^3) of the cell with the corners @p vertices, negative for
 * reversed orientation; accurate far from the origin, too. */
template <int dim>
double cell_volume(const std::vector<dealii::Point<dim>> &points,
                   const std::vector<unsigned int> &vertices);

/**
 * Evaluates the cells of a mesh.
 * @throws UserError if a corner is flat or inverted (the cell is twisted or concave, and
 * shape functions have no gradient somewhere in it), or if a cell lies so far from the
 * origin that coordinates do not resolve its corners
 */
template <int dim>
MeshQuality<dim> cell_quality(const Mesh<dim> &mesh);
} // namespace mesoslip

#endif
