#ifndef mesoslip_elasticity_ml_conjugate_gradients_h
#define mesoslip_elasticity_ml_conjugate_gradients_h

#include "elasticity/static_solver.h"

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace mesoslip
{
/**
 * Conjugate gradients with Trilinos' ML on a stiffness matrix of which some rows are
 * held: what AssembledSolver and AssembledGridSolver share.
 */
class MlConjugateGradients
{
public:
  /** Distributed vector. */
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** Distributed matrix. */
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /** @p matrix must outlive this object. @p rigid_motions[k]: the entries of motion k in
   *  the locally owned rows, in their order. */
  MlConjugateGradients(const Matrix &matrix,
                       const std::vector<std::vector<double>> &rigid_motions,
                       const unsigned int n_components);

  /** Builds the preconditioner for these held degrees of freedom. */
  void set_held(const dealii::IndexSet &held);

  /** As AssembledSolver::solve(). */
  SolverReport solve(Vector &u, const Vector &force, const double tolerance) const;

private:
  void copy_without_held();

  const Matrix &matrix;
  std::vector<std::vector<double>> motions;
  unsigned int n_components;
  dealii::IndexSet held;
  /** With rows and columns of held entries replaced by the diagonal. */
  Matrix constrained;
  std::vector<double> null_space;
  dealii::TrilinosWrappers::PreconditionAMG preconditioner;
};
} // namespace mesoslip

#endif
