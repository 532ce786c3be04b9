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
  /** A cell with @p n_vertices corners. */
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
  /** A face with @p n_vertices corners. */
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

/** Curvature of an edge, face or cell: position of the node in its middle. */
template <int dim>
struct Bulge
{
  std::vector<unsigned int>
    corners; ///< corners of the edge, face or cell: indices into the points, in ascending
             ///< order
  dealii::Tensor<1, dim> offset; ///< offset of the node from the mean of the corners (m)

  /** Saves or restores all members (Boost.Serialization). */
  template <class Archive>
  void serialize(Archive &archive, const unsigned int)
  {
    serialize_members<2>(archive, *this);
  }
};

/** A mesh of a whole body, before partitioning. */
template <int dim>
struct Mesh
{
  /** Corners of the cells (m). */
  std::vector<dealii::Point<dim>> points;

  std::vector<Cell> cells; ///< triangles and quadrilaterals, or tetrahedra, or hexahedra
  std::vector<Face>
    faces; ///< faces of groups, once per group, on the boundary of the body or not

  /** For quadratic cells, sorted by corners; edges, faces and cells not listed are
   * straight. */
  std::vector<Bulge<dim>> bulges;

  std::vector<std::string> phases;     ///< names of the cell groups
  std::vector<std::string> boundaries; ///< names of the groups of edges (2D) or faces

  std::size_t n_turned = 0; ///< number of cells with reversed corners in the file

  /** Tolerance of points on the sides of a box and of opposite points, in edge
   * lengths. */
  double tolerance = 1e-3;

  /** Periodic master of each point; a master is its own. Empty without periodic sides.
   * See join_sides(). */
  std::vector<unsigned int> masters;

  /** Periodic master of @p point, which may be @p point itself. */
  unsigned int master(const unsigned int point) const
  {
    return masters.empty() ? point : masters[point];
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
