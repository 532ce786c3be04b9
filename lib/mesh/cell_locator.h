#ifndef mesoslip_mesh_cell_locator_h
#define mesoslip_mesh_cell_locator_h

#include "mesh/mesh.h"

#include <memory>
#include <optional>

namespace mesoslip
{
/** Finds the cells of a mesh that hold points, by a tree of their bounding boxes. */
template <int dim>
class CellLocator
{
public:
  /** The mesh must outlive this object. */
  explicit CellLocator(const Mesh<dim> &mesh);

  /** Searches only some cells of the mesh. */
  CellLocator(const Mesh<dim> &mesh, const std::vector<unsigned int> &cells);

  /**
   * The cell that holds @p point; of several the one with the largest number. A point
   * may lie outside all cells by a quarter of the diameter of the nearest one, since
   * meshes approximate curved boundaries differently. Empty if there is no such cell.
   */
  std::optional<unsigned int> find(const dealii::Point<dim> &point) const;

private:
  double depth(const unsigned int cell, const dealii::Point<dim> &point) const;

  const Mesh<dim> &mesh;

  struct Boxes; // defined in the .cc file: takes seconds to compile
  std::shared_ptr<const Boxes> boxes;
};
} // namespace mesoslip

#endif
