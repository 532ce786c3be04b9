#ifndef mesoslip_elasticity_assembled_solver_h
#define mesoslip_elasticity_assembled_solver_h

#include "elasticity/assembled_operator.h"
#include "elasticity/static_solver.h"

#include <memory>

namespace dealii
{
class IndexSet;
} // namespace dealii

namespace mesoslip
{
/**
 * Static equilibrium K u = f on any mesh: conjugate gradients with Trilinos' algebraic
 * multigrid ML, which is told the rigid motions. Parallel where the operator is.
 */
template <int dim>
class AssembledSolver
{
public:
  /** @p stiffness must outlive the solver. Nothing is held yet. */
  explicit AssembledSolver(const AssembledOperator<dim> &stiffness);

  ~AssembledSolver();

  /**
   * Holds these degrees of freedom (each rank names at least those it owns). They have to
   * leave no rigid motion. Sets up the preconditioner.
   */
  void set_held(const dealii::IndexSet &held);

  /**
   * Solves for the free entries of @p u; the held ones are prescribed values on entry,
   * the others a first guess. Throws NotConverged.
   */
  SolverReport solve(dealii::TrilinosWrappers::MPI::Vector &u,
                     const dealii::TrilinosWrappers::MPI::Vector &force,
                     const double tolerance);

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};

/**
 * AssembledSolver on a uniform grid, as StaticSolver: another integration, another
 * matrix and another preconditioner than those of MultigridSolver, to check it or to
 * stand in for it. On this rank alone. Periodic sides are joined in the matrix.
 */
class AssembledGridSolver : public StaticSolver
{
public:
  /** Assembles K of @p material. */
  explicit AssembledGridSolver(const UniformMaterial &material);

  ~AssembledGridSolver() override;

  void set_held(const DofMask &mask) override;

  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};
} // namespace mesoslip

#endif
