#ifndef mesoslip_mesh_boundary_h
#define mesoslip_mesh_boundary_h

#include "mesh/mesh.h"

#include <array>

namespace mesoslip
{
/** A face (2D: edge) of one cell only, and so on the boundary of the body. */
template <int dim>
struct BoundaryFace
{
  static constexpr unsigned int max_points = 1U << (dim - 1); ///< of a quadrilateral

  std::array<unsigned int, max_points> points; ///< in the order of deal.II
  unsigned int n_points = 0;                   ///< three of a triangle
  unsigned int cell     = 0;                   ///< that it belongs to
};

/**
 * The faces on the boundary.
 * @throws UserError if more than two cells share a face, or two on the same side of it, so that
 * cells overlap or are there twice, or if the cells are not all connected through faces
 */
template <int dim>
std::vector<BoundaryFace<dim>> boundary_faces(const Mesh<dim> &mesh);

/** The pairs of cells that share a face, each once. */
template <int dim>
std::vector<std::array<unsigned int, 2>> neighbouring_cells(const Mesh<dim> &mesh);

/** Points of a part of the boundary and the areas that they stand for. */
template <int dim>
struct BoundaryPoints
{
  std::vector<unsigned int> points; ///< in ascending order

  /** Integral of the outward normal times the shape function of each point: its tributary
   * length (2D, m) or area (3D, m^2) in the direction of the normal. */
  std::vector<dealii::Tensor<1, dim>> normal_area;
};

/** The points of @p faces; exact also where a quadrilateral is not plane. */
template <int dim>
BoundaryPoints<dim> boundary_points(const Mesh<dim> &mesh,
                                    const std::vector<BoundaryFace<dim>> &faces);

/** Those of @p faces that belong to group @p boundary of the mesh. */
template <int dim>
std::vector<BoundaryFace<dim>> faces_of_group(const Mesh<dim> &mesh,
                                              const std::vector<BoundaryFace<dim>> &faces,
                                              const unsigned int boundary);

/** How many faces group @p boundary has in the file, in the body and outside of it too. */
template <int dim>
std::size_t n_faces_in_file(const Mesh<dim> &mesh, const unsigned int boundary);

/**
 * Why the faces of group @p boundary in the file are more than @p found, those of them that bound the
 * body: "are listed twice; ..." or "are not on the boundary of the body; ...".
 */
template <int dim>
std::string why_not_found(const Mesh<dim> &mesh,
                          const std::vector<BoundaryFace<dim>> &found,
                          const unsigned int boundary);

/** "(0.1, 0.2) m", the middle of the face. */
template <int dim>
std::string place_of(const Mesh<dim> &mesh, const BoundaryFace<dim> &face);

/** Shortest distance of two corners (m). */
template <int dim>
double shortest_edge(const Mesh<dim> &mesh, const BoundaryFace<dim> &face);

/**
 * The faces on the sides of the bounding box, numbered as deal.II does: 2 d at the lower,
 * 2 d + 1 at the upper end of axis d. Points may be off by Mesh::tolerance edges of the face.
 * @throws UserError if one lies on no side, as then the body is not a box.
 */
template <int dim>
std::array<std::vector<BoundaryFace<dim>>, 2UL * dim>
faces_of_box(const Mesh<dim> &mesh, const std::vector<BoundaryFace<dim>> &faces);
} // namespace mesoslip

#endif
