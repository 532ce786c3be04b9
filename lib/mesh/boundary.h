#ifndef mesoslip_mesh_boundary_h
#define mesoslip_mesh_boundary_h

#include "mesh/mesh.h"

#include <array>

namespace mesoslip
{
/** A face (2D: edge) of a single cell, i.e. on the boundary of the body. */
template <int dim>
struct BoundaryFace
{
  static constexpr unsigned int max_points = 1U << (dim - 1); ///< quadrilateral

  std::array<unsigned int, max_points> points; ///< in the order of deal.II
  unsigned int n_points = 0;                   ///< 3 for a triangle
  unsigned int cell     = 0;                   ///< cell that it belongs to
};

/**
 * The boundary faces.
 * @throws UserError if more than two cells share a face, or two on the same side of it
 * (cells overlap or are duplicated), or if the cells are not all connected through faces
 */
template <int dim>
std::vector<BoundaryFace<dim>> boundary_faces(const Mesh<dim> &mesh);

/** Pairs of cells that share a face, each pair once. */
template <int dim>
std::vector<std::array<unsigned int, 2>> neighbouring_cells(const Mesh<dim> &mesh);

/** Points of a part of the boundary and their tributary areas. */
template <int dim>
struct BoundaryPoints
{
  std::vector<unsigned int> points; ///< in ascending order

  /** Integral of the outward normal times the shape function of each point: its tributary
   * length (2D, m) or area (3D, m^2) in the direction of the normal. */
  std::vector<dealii::Tensor<1, dim>> normal_area;
};

/** The points of @p faces; exact for quadrilaterals that are not plane, too. */
template <int dim>
BoundaryPoints<dim> boundary_points(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &faces);

/** The @p faces that belong to group @p boundary of the mesh. */
template <int dim>
std::vector<BoundaryFace<dim>> faces_of_group(const Mesh<dim> &mesh,
                                              const std::vector<BoundaryFace<dim>> &faces,
                                              const unsigned int boundary);

/** Number of faces of group @p boundary in the file, including faces that do not bound
 * the body. */
template <int dim>
std::size_t n_faces_in_file(const Mesh<dim> &mesh, const unsigned int boundary);

/**
 * Reason why group @p boundary has more faces in the file than @p found on the boundary
 * of the body: "are listed twice; ..." or "are not on the boundary of the body; ...".
 */
template <int dim>
std::string why_not_found(const Mesh<dim> &mesh,
                          const std::vector<BoundaryFace<dim>> &found,
                          const unsigned int boundary);

/** "(0.1, 0.2) m", the middle of the face. */
template <int dim>
std::string place_of(const Mesh<dim> &mesh, const BoundaryFace<dim> &face);

/** Shortest distance between two corners (m). */
template <int dim>
double shortest_edge(const Mesh<dim> &mesh, const BoundaryFace<dim> &face);

/**
 * The faces on the sides of the bounding box, numbered as in deal.II: 2 d at the lower,
 * 2 d + 1 at the upper end of axis d. Points may be off by Mesh::tolerance edges of the
 * face.
 * @throws UserError if a face lies on no side: then the body is not a box
 */
template <int dim>
std::array<std::vector<BoundaryFace<dim>>, 2UL * dim>
faces_of_box(const Mesh<dim> &mesh, const std::vector<BoundaryFace<dim>> &faces);
} // namespace mesoslip

#endif
