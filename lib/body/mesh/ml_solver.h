#ifndef mesoslip_body_mesh_ml_solver_h
#define mesoslip_body_mesh_ml_solver_h

#include "body/mesh/algebraic_multigrid.h"
#include "body/mesh/mesh_discretization.h"

namespace mesoslip
{
/**
 * deal.II's conjugate gradients with algebraic multigrid that knows the rigid motions.
 * Distributed over the ranks of the discretization; all calls are collective.
 */
template <int dim>
class MlSolver : public StaticSolver
{
public:
  /** Body and discretization must outlive the solver. */
  MlSolver(const ElasticBody<dim> &body, const MeshDiscretization<dim> &discretization);

  void set_constrained(const DofMask &mask) override
  {
    set_constrained_on_springs(mask, {});
  }

  void set_constrained_on_springs(const DofMask &mask,
                                  const std::vector<SpringEntry> &on) override;

  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  using Vector = typename MeshDiscretization<dim>::Vector;

  void support(const std::vector<SpringEntry> &springs);
  void add_springs(const std::vector<SpringEntry> &springs,
                   DistributedMatrix &matrix) const;
  void set_up_preconditioner();
  void clear_fixed(Vector &x) const;
  void remove_motions(Vector &x) const;

  const ElasticBody<dim> &body;
  const MeshDiscretization<dim> &discretization;
  DofMask constrained_dofs;
  bool is_ready = false;       ///< whether constraints were set
  std::vector<Vector> motions; ///< unconstrained rigid motions, orthonormal

  /**
   * Per locally owned degree of freedom: constrained, periodic copy or used as support.
   */
  std::vector<bool> fixed;

  /** Stiffness; rows and columns of fixed degrees of freedom have only their diagonal. */
  DistributedMatrix constrained;
  DistributedMatrix gentle; ///< likewise for to_precondition(), if it is another matrix
  AlgebraicMultigrid preconditioner;
};
} // namespace mesoslip

#endif
