#ifndef mesoslip_mesh_mesh_h
#define mesoslip_mesh_mesh_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria_description.h>

#include <string>
#include <vector>

namespace mesoslip
{
/**
 * A mesh of a whole body in the terms of dealii::Triangulation::create_triangulation(),
 * before it is divided among the ranks.
 */
template <int dim>
struct Mesh
{
  /** Corners of the cells (m). */
  std::vector<dealii::Point<dim>> points;

  /** Triangles and quadrilaterals, or tetrahedra, or hexahedra, with their corners in the
   * order of deal.II; material_id is an index into @p phases. */
  std::vector<dealii::CellData<dim>> cells;

  /** Edges (2D) or faces on the boundary of the body that belong to a group; boundary_id
   * is an index into @p boundaries. */
  std::vector<dealii::CellData<dim - 1>> faces;

  std::vector<std::string> phases;     ///< names of the groups of cells
  std::vector<std::string> boundaries; ///< names of the groups of edges (2D) or faces

  std::size_t n_turned = 0; ///< cells whose corners the file has in the reverse order

  /** With periodic sides: for each point the one that it moves with, itself where it is the
   * original; empty without such sides. See join_sides(). */
  std::vector<unsigned int> originals;

  /** The point that moves as @p point does, which may be itself. */
  unsigned int original(const unsigned int point) const
  {
    return originals.empty() ? point : originals[point];
  }
};
} // namespace mesoslip

#endif
