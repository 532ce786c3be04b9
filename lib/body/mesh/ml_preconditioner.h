#ifndef mesoslip_body_mesh_ml_preconditioner_h
#define mesoslip_body_mesh_ml_preconditioner_h

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

namespace mesoslip
{
/**
 * Smoothed aggregation of Trilinos ML for a stiffness matrix with dim degrees of freedom a
 * node, one after the other. Coarse spaces contain @p near_null_space, the rigid motions
 * (zero where degrees of freedom are fixed): with these the number of iterations grows
 * slowly with the size of the mesh, without them as fast as without a preconditioner.
 * Matrix and vectors must outlive it. Collective.
 */
class MlPreconditioner
{
public:
  using Vector = dealii::TrilinosWrappers::MPI::Vector; ///< owned degrees of freedom

  /** Sets it up anew. */
  void initialize(const dealii::TrilinosWrappers::SparseMatrix &matrix,
                  const unsigned int dim,
                  const std::vector<Vector> &near_null_space);

  /** y = P^-1 x. */
  void vmult(Vector &y, const Vector &x) const
  {
    ml.vmult(y, x);
  }

private:
  std::vector<double> null_space; ///< vector after vector, as ML wants them
  dealii::TrilinosWrappers::PreconditionAMG ml;
};
} // namespace mesoslip

#endif
