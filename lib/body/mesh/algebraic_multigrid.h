#ifndef mesoslip_body_mesh_algebraic_multigrid_h
#define mesoslip_body_mesh_algebraic_multigrid_h

#include "body/mesh/distributed_matrix.h"

namespace mesoslip
{
/**
 * Smoothed aggregation for a stiffness matrix with some degrees of freedom a node, one after the
 * other: ML of Trilinos, or GAMG of PETSc, as CMake was told (MESOSLIP_MULTIGRID). Coarse spaces
 * contain @p near_null_space, the rigid motions (zero where degrees of freedom are fixed): with
 * these the number of iterations grows slowly with the size of the mesh, without them as fast as
 * without a preconditioner. Matrix and vectors must outlive it. Collective.
 */
class AlgebraicMultigrid
{
public:
  using Vector = DistributedVector; ///< owned degrees of freedom

  AlgebraicMultigrid();
  ~AlgebraicMultigrid();

  /** "ML" or "GAMG". */
  static const char *name();

  /** Sets it up anew. */
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
