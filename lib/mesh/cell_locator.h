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
  /** The mesh must outlive it. */
  explicit CellLocator(const Mesh<dim> &mesh);

  /** Of some cells of the mesh. */
  CellLocator(const Mesh<dim> &mesh, const std::vector<unsigned int> &cells);

  /**
   * The cell that holds @p point; of several that share it, the one with the largest
   * number. Near a curved boundary, which meshes approximate each in its own way, a point
   * may lie outside all cells by a quarter of the diameter of the nearest one. Nothing
   * if there is no such cell.
   */
  std::optional<unsigned int> find(const dealii::Point<dim> &point) const;

private:
  double depth(const unsigned int cell, const dealii::Point<dim> &point) const;

  const Mesh<dim> &mesh;

  struct Boxes; // takes seconds to compile
  std::shared_ptr<const Boxes> boxes;
};
} // namespace mesoslip

#endif
