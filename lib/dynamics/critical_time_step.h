#ifndef mesoslip_dynamics_critical_time_step_h
#define mesoslip_dynamics_critical_time_step_h

#include "elasticity/brick/brick_operator.h"
#include "elasticity/mesh_operator.h"
#include "elasticity/uniform_material.h"

#include <functional>
#include <vector>

namespace mesoslip
{
/**
 * Largest stable time step (s) for the circular frequency @p omega (1/s): with
 * W = omega dt and xi = beta omega / 2, b W^2 + 2 xi W - 2 = 0, that is
 * W = (sqrt(xi^2 + 2 b) - xi) / b.
 */
double critical_time_step(const double omega, const double beta2, const double beta);

/** Estimate of the largest circular frequency of M^-1 K (1/s). */
struct FrequencyEstimate
{
  /** Largest Ritz value, a lower bound (1/s). */
  double lower = 0.;

  /**
   * Largest Ritz value plus its residual, at most the element bound; use this one (1/s).
   */
  double upper = 0.;

  /** Number of operator applications. */
  unsigned int iterations = 0;
};

/**
 * Largest frequency of a single cell with its own quarter masses, over all phases (1/s):
 * an upper bound for every mesh of these cells and all constraints.
 */
double element_frequency_bound(const UniformMaterial &material);

/**
 * Lanczos iteration on M^-1/2 K M^-1/2 on the unconstrained grid, until the upper
 * estimate is within @p tolerance of the lower one, or @p max_iterations. Constraints and
 * periodic sides only lower frequencies, so the estimate holds for them, too.
 */
FrequencyEstimate largest_frequency(const UniformMaterial &material,
                                    const double tolerance            = 2e-3,
                                    const unsigned int max_iterations = 120);

/**
 * Lanczos estimate on a mesh. Collective; the same on any number of ranks up to
 * round-off.
 */
template <int dim>
FrequencyEstimate largest_frequency(const MeshOperator<dim> &op,
                                    const double tolerance            = 2e-3,
                                    const unsigned int max_iterations = 120);

/** Lanczos estimate on a box of bricks. Collective. */
FrequencyEstimate largest_frequency(const BrickOperator &op,
                                    const double tolerance            = 2e-3,
                                    const unsigned int max_iterations = 120);

/**
 * Upper bound for a box of one phase under any constraints, from blocks of some thousand
 * cells into which it can be cut. Energy and mass of the box are sums over the blocks, so
 * that no vibration is faster than the fastest one of a free block. A fraction of a
 * percent above largest_frequency() of the box. Each rank computes it alone, with the
 * same bits.
 */
FrequencyEstimate largest_frequency_of_blocks(const UniformGrid<3> &grid,
                                              const ElasticPhase<3> &phase,
                                              const InstructionSet isa);

/** critical_time_step() with the upper estimate of largest_frequency(). */
double critical_time_step(const UniformMaterial &material,
                          const double beta2,
                          const double beta);
} // namespace mesoslip

#endif
