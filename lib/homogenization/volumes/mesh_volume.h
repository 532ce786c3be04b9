#ifndef mesoslip_homogenization_mesh_volume_h
#define mesoslip_homogenization_mesh_volume_h

#include "body/mesh/algebraic_multigrid.h"
#include "body/mesh/distributed_mesh.h"
#include "elasticity/uniform_material.h"
#include "homogenization/volumes/volume_element.h"

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace mesoslip
{
/**
 * A volume element on a mesh: a box, divided among the ranks by METIS, with the load
 * cases of KUBC, SUBC, PBC and MUBC solved by conjugate gradients with ML. All ranks hold a
 * part of the mesh and of the fields.
 */
template <int dim>
class MeshVolume : public VolumeElement<dim>
{
public:
  using typename VolumeElement<dim>::Action;
  using typename VolumeElement<dim>::Sample;
  using typename VolumeElement<dim>::Values;

  /** @p given is the mesh of rank 0; @p the_phases (stiffness in Pa) are those of its
   * cells, on which displacements have the @p degree 1 or 2. Collective. @throws UserError if the body is no
   * box */
  MeshVolume(const Mesh<dim> &given,
             const std::vector<ElasticPhase<dim>> &the_phases,
             const MPI_Comm communicator,
             const unsigned int degree = 1);

  /** @throws NotConverged, UserError if opposite sides have points that are not opposite (PBC) */
  VolumeSums<dim> solve(const BoundaryCondition wanted,
                        const double tolerance,
                        const std::function<void()> &case_done = {}) override;

  MPI_Comm communicator() const override
  {
    return mesh.communicator();
  }
  void for_each(const Action &action) const override;
  void for_each_sample(const Sample &visit) const override;
  void write(const std::string &path,
             const std::vector<CellDataset> &datasets,
             const std::size_t n,
             const Values &values) const override;

private:
  using Index                           = typename DistributedMesh<dim>::Index;
  using Vector                          = AlgebraicMultigrid::Vector;
  static constexpr unsigned int heat    = n_voigt<dim>; ///< number of its load case
  static constexpr unsigned int n_loads = heat + 1;

  void set_constraints(const unsigned int k);
  void assemble();
  void find_sides(const Mesh<dim> &given);
  void find_duplicates(const double tolerance);
  std::vector<Vector> rigid_motions() const;
  SolverReport solve_case(const unsigned int k, const double tolerance);
  VolumeSums<dim> integrate() const;

  /** Calls action(number in the mesh, cell) with each cell of this rank. */
  void for_each_cell(
    const std::function<void(const std::uint64_t, const LocalCell<dim> &)> &action) const;

  /** Calls visit(cell, strains, JxW) at each quadrature point of the cells of this rank. */
  template <typename Visit>
  void for_each_point(const Visit &visit) const;

  /** A degree of freedom on a side. */
  struct OnSide
  {
    Index dof;
    unsigned int component;
    std::array<double, dim> at; ///< where its node is (m)
  };

  const std::vector<ElasticPhase<dim>> phases;
  DistributedMesh<dim> mesh;
  std::array<std::vector<OnSide>, 2UL * dim> sides; ///< on all ranks
  std::vector<Index> supports;                      ///< just enough against rigid motions

  /** Degrees of freedom of upper sides and opposite ones of lower sides, axis after axis; or why
   * there are none. */
  std::vector<std::array<Index, 2>> duplicates;
  std::string not_periodic;

  dealii::AffineConstraints<double> constraints;
  const bool is_apart; ///< whether a phase has mean dilatation
  DistributedMatrix matrix,
    gentle; ///< the second one of phase_to_precondition(), if that is another one
  AlgebraicMultigrid preconditioner;
  std::vector<Vector> loads;
  std::vector<double> gross_loads; ///< norms of the loads before they cancel

  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  std::vector<Vector> solutions; ///< with the values that cells of this rank need
};
} // namespace mesoslip

#endif
