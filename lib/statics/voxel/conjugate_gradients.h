#ifndef mesoslip_statics_voxel_conjugate_gradients_h
#define mesoslip_statics_voxel_conjugate_gradients_h

#include "statics/static_solver.h"
#include "statics/voxel/stiffness.h"

#include <functional>

namespace mesoslip::voxel
{
/**
 * Conjugate gradients in single precision with a multigrid cycle; the displacements and, from time
 * to time, the residual are in double precision.
 */
class ConjugateGradients
{
public:
  /** What is solved. */
  struct Problem
  {
    /** Forces on displacements (with ghosts) that nothing balances, zero at held components, and
     *  the square of their norm. Collective. */
    std::function<double(VoxelField<double> &, VoxelField<float> &)> residual;

    /** Improves the solution of multigrid for a force. May be empty. */
    std::function<void(VoxelField<float> &, const VoxelField<float> &)> improve;

    /** A residual of these displacements that is round-off, with which they are left. May be empty.
     *  Collective. */
    std::function<double(const VoxelField<double> &)> round_off;

    double tolerance    = 0.;   ///< of the residual, relative to that at the start
    double negligible   = 0.;   ///< a residual that is none
    unsigned int limit  = 2000; ///< largest number of iterations
    double trusted_drop = 1e-4; ///< of the residual after which it is computed anew
  };

  /** @p stiffness outlives this. */
  explicit ConjugateGradients(const Stiffness &stiffness);

  ConjugateGradients(const ConjugateGradients &) = delete; ///< refers to its owner's
  ConjugateGradients &
  operator=(const ConjugateGradients &) = delete; ///< see the constructor

  /** Improves @p u from where it is; ghosts are set. Collective. @throws NotConverged */
  SolverReport solve(VoxelField<double> &u, Multigrid &multigrid, const Problem &problem);

  /** Gives back the memory of directions. */
  void release();

  VoxelField<float> r; ///< the residual
  SolverReport report; ///< of the last solve, also of one that has not converged

private:
  const Stiffness &stiffness;
  VoxelField<float> p, z;
};
} // namespace mesoslip::voxel

#endif
