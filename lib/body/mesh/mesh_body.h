#ifndef mesoslip_body_mesh_mesh_body_h
#define mesoslip_body_mesh_mesh_body_h

#include "body/point_body.h"
#include "elasticity/uniform_material.h"
#include "mesh/mesh.h"

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/** A mesh with everything that makes a body of it. */
template <int dim>
struct MeshBodyInput
{
  Mesh<dim> mesh; ///< material_id of its cells is an index into phases

  std::vector<ElasticPhase<dim>> phases; ///< stiffness (Pa) and density (kg/m^3)

  /** Sides of the bounding box that are one, in 2D; with Mesh::originals the axes along
   * which these repeat the mesh. */
  Periodicity periodicity = {};

  /** Fields have the points in rows of this many; 0: all in one row. */
  unsigned int n_columns = 0;

  /** Name of the group of faces that rub; empty: the lower side of the bounding box. */
  std::string contact_boundary = {};

  /** Name of the group of faces that are loaded; empty: the upper side. */
  std::string top_boundary = {};
};

/** The cells of a uniform grid as quadrilaterals, with fields in the layout of the grid.
 */
MeshBodyInput<2> mesh_of_grid(const UniformMaterial &material);

/** Every quadrilateral of @p mesh cut into two triangles, in alternating directions. */
Mesh<2> cut_into_triangles(const Mesh<2> &mesh);

template <int dim>
class MeshDiscretization;
template <int dim>
struct MeshShare;

/**
 * The body on a mesh of deal.II, elements of order one, in two dimensions or three:
 * stiffness as a DistributedMatrix, solves by MlSolver. Work and matrices are divided among
 * the ranks by METIS.
 */
template <int dim>
class MeshBody final : public PointBody<dim>
{
public:
  using Cells = typename ElasticBody<dim>::Cells; ///< values in a group of cells

  /** With mesh and fields that are whole on all ranks, which all have the same @p given.
   * Collective over @p communicator. @throws UserError
   * if a cell is flat or inside out, the body is in pieces, a boundary has no face, or the
   * sides of a periodic mesh do not match */
  MeshBody(const MeshBodyInput<dim> &given, const MPI_Comm communicator);

  /** With fields that are divided like the cells. Only rank 0 has to have @p mesh, which stands in
   * for that of @p given. Collective. @throws UserError as above */
  static std::unique_ptr<MeshBody> divide(const Mesh<dim> &mesh,
                                          const MeshBodyInput<dim> &given,
                                          const MPI_Comm communicator);

  ~MeshBody() override;

  std::optional<NodeIndex> find(const unsigned int number) const override;

  /** Points and cells of the fields of this rank. */
  const Mesh<dim> &local_mesh() const
  {
    return mesh;
  }

  /** Numbers in the mesh of the cells of local_mesh(). */
  const std::vector<unsigned int> &cell_numbers() const
  {
    return cell_in_mesh;
  }

  void copy_duplicates(NodalField<double> &field) const override;
  using ElasticBody<dim>::copy_duplicates;
  std::uint64_t number(const NodeIndex &node) const override;
  std::array<double, dim> point(const NodeIndex &node) const override;
  std::vector<double> mass_of_cells() const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  void multiply(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::vector<MatrixEntry> stiffness_entries() const override;
  std::unique_ptr<StaticSolver> make_solver() const override;
  std::unique_ptr<ElasticBody<dim>> make_periodic() const override;

private:
  MeshBody(const MeshBodyInput<dim> &given, MeshShare<dim> &&share);

  NodeIndex node(const std::size_t point) const;
  void set_sides(const MeshShare<dim> &share);

  const MeshBodyInput<dim> input;           ///< its mesh has the points of fields
  const Mesh<dim> &mesh;                    ///< the same: points and cells of this rank
  const MPI_Comm all_ranks;                 ///< that share the work
  const std::array<double, dim> lower;      ///< corner of the bounding box (m)
  const std::vector<unsigned int> in_mesh;  ///< see MeshShare::point_in_mesh
  const std::vector<unsigned int> in_order; ///< points of fields, by in_mesh
  const std::vector<unsigned int> cell_in_mesh; ///< see cell_numbers()
  const std::vector<double> volumes;            ///< of the cells (m^2, m^3)
  std::unique_ptr<MeshDiscretization<dim>> discretization;
};
} // namespace mesoslip

#endif
