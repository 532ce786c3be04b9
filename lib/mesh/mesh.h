#ifndef mesoslip_mesh_mesh_h
#define mesoslip_mesh_mesh_h

#include "base/serialize_members.h"

#include <deal.II/base/point.h>

#include <algorithm>
#include <string>
#include <vector>

namespace mesoslip
{
/** A triangle or quadrilateral, tetrahedron or hexahedron. */
struct Cell
{
  /** One of @p n_vertices corners. */
  explicit Cell(const std::size_t n_vertices = 0)
    : vertices(n_vertices)
  {
  }

  std::vector<unsigned int>
    vertices;                   ///< indices into the points, in the order of deal.II
  unsigned int material_id = 0; ///< index into the phases of the mesh

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

/** An edge (2D) or face on the boundary that belongs to a group. */
struct Face
{
  /** One of @p n_vertices corners. */
  explicit Face(const std::size_t n_vertices = 0)
    : vertices(n_vertices)
  {
  }

  std::vector<unsigned int>
    vertices;                   ///< indices into the points, in the order of deal.II
  unsigned int boundary_id = 0; ///< index into the boundaries of the mesh

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

/** How an edge, face or cell is curved: where the node in its middle is. */
template <int dim>
struct Bulge
{
  std::vector<unsigned int>
    corners; ///< of the edge, face or cell: indices into the points, in ascending order
  dealii::Tensor<1, dim> offset; ///< of the node from the mean of the corners (m)

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

/** A mesh of a whole body, before it is divided among the ranks. */
template <int dim>
struct Mesh
{
  /** Corners of the cells (m). */
  std::vector<dealii::Point<dim>> points;

  std::vector<Cell> cells; ///< triangles and quadrilaterals, or tetrahedra, or hexahedra
  std::vector<Face>
    faces; ///< those of groups, once in each, whether or not they bound the body

  /** Of quadratic cells, in ascending order of their corners; what is not in it is straight. */
  std::vector<Bulge<dim>> bulges;

  std::vector<std::string> phases;     ///< names of the groups of cells
  std::vector<std::string> boundaries; ///< names of the groups of edges (2D) or faces

  std::size_t n_turned = 0; ///< cells whose corners the file has in the reverse order

  /** How far points may be off the sides of a box and the points opposite, in edges. */
  double tolerance = 1e-3;

  /** With periodic sides: for each point the one that it moves with, itself where it is the
   * original; empty without such sides. See join_sides(). */
  std::vector<unsigned int> originals;

  /** The point that moves as @p point does, which may be itself. */
  unsigned int original(const unsigned int point) const
  {
    return originals.empty() ? point : originals[point];
  }

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<9>(archive, *this);
  }
};

/** Whether some cells are triangles or tetrahedra. */
template <int dim>
bool has_simplices(const Mesh<dim> &mesh)
{
  return std::any_of(mesh.cells.begin(), mesh.cells.end(),
                     [](const Cell &cell) { return cell.vertices.size() == dim + 1; });
}
} // namespace mesoslip

#endif
