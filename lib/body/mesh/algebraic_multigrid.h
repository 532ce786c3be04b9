#ifndef mesoslip_body_mesh_algebraic_multigrid_h
#define mesoslip_body_mesh_algebraic_multigrid_h

#include "body/mesh/distributed_matrix.h"

namespace mesoslip
{
/**
 * Smoothed aggregation multigrid for a stiffness matrix whose degrees of freedom are
 * numbered node by node: ML of Trilinos or GAMG of PETSc, as configured by
 * MESOSLIP_MULTIGRID. Coarse spaces contain @p near_null_space, the rigid motions (zero
 * at constrained degrees of freedom). The number of iterations then grows slowly with the
 * size of the mesh; without these vectors it grows as fast as without a preconditioner.
 * Matrix and vectors must outlive it. Collective.
 */
class AlgebraicMultigrid
{
public:
  using Vector = DistributedVector; ///< values of locally owned degrees of freedom

  AlgebraicMultigrid();
  ~AlgebraicMultigrid();

  /** "ML" or "GAMG". */
  static const char *name();

  /** Sets up the preconditioner for @p matrix. */
  void initialize(const DistributedMatrix &matrix,
                  const std::vector<Vector> &near_null_space);

  /** y = P^-1 x. */
  void vmult(Vector &y, const Vector &x) const;

private:
  struct Library;
  std::unique_ptr<Library> library;
};
} // namespace mesoslip

#endif
