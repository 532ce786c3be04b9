#ifndef mesoslip_statics_grid_solver_h
#define mesoslip_statics_grid_solver_h

#include "elasticity/uniform_material.h"
#include "statics/static_solver.h"

#include <memory>

namespace mesoslip
{
/**
 * Flexible conjugate gradients in double precision on UniformGridOperator. What u brings
 * in free entries is the first guess.
 *
 * StaticSolverKind::multigrid: preconditioned by one cycle of multigrid::Multigrid in
 * single precision. About ten iterations for the contrasts of composites, whatever the
 * size; time and memory linear in the number of cells. When single precision breaks down
 * or takes more than 100 iterations, the rest of this and all further solves with the
 * same mask have the cycle in double precision. StaticSolverKind::jacobi: preconditioned
 * by the diagonal, which needs no set-up and up to 100000 iterations.
 *
 * All rows on one rank; independent load cases go to different ranks. Not for use by two
 * threads at a time.
 */
class GridSolver : public StaticSolver
{
public:
  /** Sets up what does not depend on which displacements are held. */
  explicit GridSolver(const UniformMaterial &material,
                      const StaticSolverKind kind = StaticSolverKind::multigrid,
                      const std::optional<unsigned int> &max_iterations = {});

  ~GridSolver() override;

  /** Costs about as much as two solves, nothing if the mask has not changed. Throws
   *  std::invalid_argument if it has another size than the grid. */
  void set_held(const DofMask &mask) override;

  /** Where rigid motions are left, what the forces have of them (round-off, one hopes) is
   *  ignored. */
  SolverReport solve(NodalField<double> &u,
                     const NodalField<double> &force,
                     const double tolerance) override;

  /** Number of grids of the multigrid hierarchy. */
  unsigned int n_levels() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};
} // namespace mesoslip

#endif
