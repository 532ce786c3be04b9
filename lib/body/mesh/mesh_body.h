#ifndef mesoslip_body_mesh_mesh_body_h
#define mesoslip_body_mesh_mesh_body_h

#include "body/elastic_body.h"
#include "body/mesh/mesh.h"

namespace mesoslip
{
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
