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
 * A volume element on a mesh of a box, partitioned among the ranks by METIS. Load cases
 * of KUBC, SUBC, PBC and MUBC are solved by conjugate gradients with ML. Every rank
 * holds its part of the mesh and of the fields.
 */
template <int dim>
class MeshVolume : public VolumeElement<dim>
{
public:
  using typename VolumeElement<dim>::Action;
  using typename VolumeElement<dim>::Sample;
  using typename VolumeElement<dim>::Values;

  /** @p given is the mesh on rank 0, @p the_phases are the phases of its cells (stiffness
   * in Pa), @p degree (1 or 2) is the polynomial degree of displacements. Collective.
   * @throws UserError if the body is not a box */
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
  void find_copies(const double tolerance);
  std::vector<Vector> rigid_motions() const;
  SolverReport solve_case(const unsigned int k, const double tolerance);
  VolumeSums<dim> integrate() const;

  /** Calls action(number in the mesh, cell) for each locally owned cell. */
  void for_each_cell(
    const std::function<void(const std::uint64_t, const LocalCell<dim> &)> &action) const;

  /** Calls visit(cell, strains, JxW) at each quadrature point of the locally owned
   * cells. */
  template <typename Visit>
  void for_each_point(const Visit &visit) const;

  /** A degree of freedom on a side. */
  struct OnSide
  {
    Index dof;
    unsigned int component;
    std::array<double, dim> at; ///< support point of the degree of freedom (m)
  };

  const std::vector<ElasticPhase<dim>> phases;
  DistributedMesh<dim> mesh;
  std::array<std::vector<OnSide>, 2UL * dim> sides; ///< same on all ranks
  std::vector<Index> supports;                      ///< statically determinate

  /** Pairs (dof of an upper side, opposite dof of the lower side), axis by axis; if there
   * are none, not_periodic says why. */
  std::vector<std::array<Index, 2>> copies;
  std::string not_periodic;

  dealii::AffineConstraints<double> constraints;
  const bool is_apart; ///< whether a phase has mean dilatation
  DistributedMatrix matrix,
    gentle; ///< matrix with phase_to_precondition(), if it differs from `matrix`
  AlgebraicMultigrid preconditioner;
  std::vector<Vector> loads;
  std::vector<double> gross_loads; ///< norms of the load vectors before terms cancel

  BoundaryCondition condition = BoundaryCondition::KUBC; ///< solved last
  std::vector<Vector> solutions;                         ///< with ghost values
};
} // namespace mesoslip

#endif
