#ifndef mesoslip_body_mesh_mesh_h
#define mesoslip_body_mesh_mesh_h

#include "elasticity/uniform_material.h"

#include <array>
#include <cstdint>
#include <vector>

namespace mesoslip
{
/** A mesh of a body with plane sides as plain arrays, before it is distributed. */
template <int dim>
struct Mesh
{
  /** The corners of the cells (m). */
  std::vector<std::array<double, dim>> points;

  /** dim + 1 (triangles, tetrahedra) or 2^dim (quadrilaterals, hexahedra). */
  unsigned int n_corners = 1U << dim;

  /** Points of each cell, n_corners a cell, in the order of deal.II. */
  std::vector<unsigned int> cells;

  /** Phase of each cell, an index into phases. */
  std::vector<std::uint8_t> phase;

  std::vector<ElasticPhase<dim>> phases; ///< stiffness (Pa) and density (kg/m^3)

  Periodicity periodicity; ///< sides of the bounding box that are one

  /** Fields have the points in rows of this many; 0: all in one row. */
  unsigned int n_columns = 0;

  /** Number of cells. */
  std::size_t n_cells() const
  {
    return cells.size() / n_corners;
  }
};

/** The cells of a uniform grid as quadrilaterals, with fields in the layout of the grid.
 */
Mesh<2> mesh_of_grid(const UniformMaterial &material);

/** Every quadrilateral of @p mesh cut into two triangles, in alternating directions. */
Mesh<2> cut_into_triangles(const Mesh<2> &mesh);

/**
 * Points of the side at the upper end of @p axis and those at its lower end that are
 * opposite, in ascending order along the side. @throws std::invalid_argument unless each
 * point has one within 1e-6 of the distance to its neighbour on the side.
 */
std::vector<std::array<unsigned int, 2>> opposite_points(const Mesh<2> &mesh,
                                                         const unsigned int axis);

/**
 * Points of a side of the bounding box, numbered as in ElasticBody::surface(), in
 * ascending order along it.
 */
std::vector<unsigned int> points_of_side(const Mesh<2> &mesh, const unsigned int side);
} // namespace mesoslip

#endif
