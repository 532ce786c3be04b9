#ifndef mesoslip_body_mesh_mesh_body_h
#define mesoslip_body_mesh_mesh_body_h

#include "body/elastic_body.h"
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

template <int dim>
class MeshDiscretization;

/**
 * The body on a mesh of deal.II, elements of order one: stiffness as a Trilinos matrix,
 * solves by MlSolver. Cells are divided among the ranks by METIS.
 */
template <int dim>
class MeshBody : public ElasticBody<dim>
{
public:
  using Cells = typename ElasticBody<dim>::Cells; ///< values in a group of cells

  /** Collective over @p communicator. @throws std::invalid_argument if a cell has no area
   * or the sides of a periodic mesh do not match. */
  explicit MeshBody(const Mesh<dim> &given, const MPI_Comm communicator);

  ~MeshBody() override;

  std::array<double, dim> point(const NodeIndex &node) const override;
  std::vector<double> lumped_mass() const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  void vmult(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::unique_ptr<StaticSolver> make_solver() const override;
  std::unique_ptr<ElasticBody<dim>> make_periodic() const override;

private:
  NodeIndex node(const std::size_t point) const;
  void find_sides();

  const Mesh<dim> mesh;
  const MPI_Comm communicator;
  std::array<double, dim> lower; ///< corner of the bounding box (m)
  std::vector<double> volumes;   ///< of the cells (m^2, m^3)
  std::unique_ptr<MeshDiscretization<dim>> discretization;
};
} // namespace mesoslip

#endif
