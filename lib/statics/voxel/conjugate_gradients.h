#ifndef mesoslip_statics_voxel_conjugate_gradients_h
#define mesoslip_statics_voxel_conjugate_gradients_h

#include "statics/static_solver.h"
#include "statics/voxel/stiffness.h"

#include <functional>

namespace mesoslip::voxel
{
/**
 * Conjugate gradients in single precision with a multigrid cycle; the displacements and,
 * from time to time, the residual are computed in double precision.
 */
class ConjugateGradients
{
public:
  /** The problem to solve. */
  struct Problem
  {
    /** Computes the residual forces of displacements (with ghosts), zero at constrained
     * components; returns the square of their norm. Collective. */
    std::function<double(VoxelField<double> &, VoxelField<float> &)> residual;

    /** Improves the solution of multigrid for a force. May be empty. */
    std::function<void(VoxelField<float> &, const VoxelField<float> &)> improve;

    /** Size of the round-off in the residual of these displacements; reaching it ends the
     * solve. May be empty. Collective. */
    std::function<double(const VoxelField<double> &)> round_off;

    double tolerance    = 0.;   ///< relative to the initial residual
    double negligible   = 0.;   ///< residual that counts as zero
    unsigned int limit  = 2000; ///< largest number of iterations
    double trusted_drop = 1e-4; ///< drop of the residual after which it is recomputed
  };

  /** @p stiffness must outlive this object. */
  explicit ConjugateGradients(const Stiffness &stiffness);

  ConjugateGradients(const ConjugateGradients &) = delete; ///< refers to its owner
  ConjugateGradients &
  operator=(const ConjugateGradients &) = delete; ///< see the constructor

  /** Solves from the initial guess @p u; ghosts are set. Collective.
   * @throws NotConverged */
  SolverReport solve(VoxelField<double> &u, Multigrid &multigrid, const Problem &problem);

  /** Frees the memory of search directions. */
  void release();

  VoxelField<float> r; ///< the residual
  SolverReport report; ///< report of the last solve, converged or not

private:
  const Stiffness &stiffness;
  VoxelField<float> p, z;
};
} // namespace mesoslip::voxel

#endif
