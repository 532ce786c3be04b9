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
/** A mesh with phases, periodicity and boundaries of a body. */
template <int dim>
struct MeshBodyInput
{
  Mesh<dim> mesh; ///< material_id of a cell is an index into phases

  std::vector<ElasticPhase<dim>> phases; ///< stiffness (Pa) and density (kg/m^3)

  /**
   * Axes with periodic sides. In 2D sides of the bounding box; with Mesh::masters the
   * axes along which these repeat the mesh.
   */
  Periodicity periodicity = {};

  /** Number of points in a row of a field; 0: all in one row. */
  unsigned int n_columns = 0;

  /**
   * Name of the face group of the contact side; empty: the lower side of the bounding
   * box.
   */
  std::string contact_boundary = {};

  /** Name of the face group of the loaded side; empty: the upper side. */
  std::string top_boundary = {};
};

/** The cells of a uniform grid as quadrilaterals, with fields in the layout of the grid.
 */
MeshBodyInput<2> mesh_of_grid(const UniformMaterial &material);

/** Cuts every quadrilateral of @p mesh into two triangles, in alternating directions. */
Mesh<2> cut_into_triangles(const Mesh<2> &mesh);

template <int dim>
class MeshDiscretization;
template <int dim>
struct MeshShare;

/**
 * The body on a deal.II mesh with elements of order one, in 2D or 3D: stiffness as
 * DistributedMatrix, solves by MlSolver. Work and matrices are distributed over the ranks
 * by METIS.
 */
template <int dim>
class MeshBody final : public PointBody<dim>
{
public:
  using Cells = typename ElasticBody<dim>::Cells; ///< values in a group of cells

  /**
   * Body with replicated mesh and fields; @p given is the same on all ranks. Collective
   * over @p communicator. @throws UserError if a cell is flat or inside out, the body is
   * in pieces, a boundary has no face, or the sides of a periodic mesh do not match
   */
  MeshBody(const MeshBodyInput<dim> &given, const MPI_Comm communicator);

  /**
   * Body with fields distributed like the cells. Only rank 0 needs @p mesh, which
   * replaces the mesh of @p given. Collective. @throws UserError as the constructor
   */
  static std::unique_ptr<MeshBody> divide(const Mesh<dim> &mesh,
                                          const MeshBodyInput<dim> &given,
                                          const MPI_Comm communicator);

  ~MeshBody() override;

  std::optional<NodeIndex> find(const unsigned int number) const override;

  /** Points and cells of the local fields. */
  const Mesh<dim> &local_mesh() const
  {
    return mesh;
  }

  /** Numbers in the whole mesh of the cells of local_mesh(). */
  const std::vector<unsigned int> &cell_numbers() const
  {
    return cell_in_mesh;
  }

  void update_copies(NodalField<double> &field) const override;
  using ElasticBody<dim>::update_copies;
  std::uint64_t number(const NodeIndex &node) const override;
  std::array<double, dim> point(const NodeIndex &node) const override;
  std::vector<double> mass_of_cells() const override;
  std::size_t n_cell_groups() const override;
  void evaluate(const NodalField<double> &u,
                const std::size_t group,
                Cells &cells) const override;
  std::vector<VoigtMatrix<dim>>
  strain_products(const NodalField<double> &u) const override;
  void multiply(NodalField<double> &Ku, const NodalField<double> &u) const override;
  std::vector<MatrixEntry> stiffness_entries() const override;
  std::unique_ptr<StaticSolver> make_solver() const override;
  std::unique_ptr<ElasticBody<dim>> make_periodic() const override;

private:
  MeshBody(const MeshBodyInput<dim> &given, MeshShare<dim> &&share);

  NodeIndex node(const std::size_t point) const;
  void set_sides(const MeshShare<dim> &share);

  const MeshBodyInput<dim> input;               ///< its mesh has the local points
  const Mesh<dim> &mesh;                        ///< mesh of input: the local part
  const MPI_Comm all_ranks;                     ///< ranks that share the work
  const std::array<double, dim> lower;          ///< corner of the bounding box (m)
  const std::vector<unsigned int> in_mesh;      ///< see MeshShare::point_in_mesh
  const std::vector<unsigned int> in_order;     ///< local points sorted by in_mesh
  const std::vector<unsigned int> cell_in_mesh; ///< see cell_numbers()
  const std::vector<double> volumes;            ///< volumes of the cells (m^2, m^3)
  std::unique_ptr<MeshDiscretization<dim>> discretization;
};
} // namespace mesoslip

#endif
