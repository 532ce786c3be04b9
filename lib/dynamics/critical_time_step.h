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

/** What is known about the largest circular frequency of M^-1 K (1/s). */
struct FrequencyEstimate
{
  /** Largest Ritz value: approached from below. */
  double lower = 0.;

  /** Largest Ritz value plus its residual, never above the element bound: the one to use.
   */
  double upper = 0.;

  /** Operator applications spent. */
  unsigned int iterations = 0;
};

/**
 * Largest frequency of a single cell with its own quarter masses, over all phases: an
 * upper bound for every mesh made of them and every constraint.
 */
double element_frequency_bound(const UniformMaterial &material);

/**
 * Lanczos iteration on M^-1/2 K M^-1/2 on the unconstrained grid (constraints and
 * periodic sides only lower the result, so it holds for them, too), until the upper
 * estimate is within @p tolerance of the lower one, or @p max_iterations.
 */
FrequencyEstimate largest_frequency(const UniformMaterial &material,
                                    const double tolerance            = 2e-3,
                                    const unsigned int max_iterations = 120);

/** The same on a mesh. Collective; the same on any number of ranks up to round-off. */
template <int dim>
FrequencyEstimate largest_frequency(const MeshOperator<dim> &op,
                                    const double tolerance            = 2e-3,
                                    const unsigned int max_iterations = 120);

/** The same on a box of bricks. Collective. */
FrequencyEstimate largest_frequency(const BrickOperator &op,
                                    const double tolerance            = 2e-3,
                                    const unsigned int max_iterations = 120);

/**
 * An upper bound for a box of one phase, whatever its constraints, of blocks of some thousand cells into which it can be cut: as
 * energy and mass of the box are sums over the blocks, none of its vibrations is faster than the fastest of
 * a free block. A fraction of a percent above largest_frequency() of the box. Each rank alone, and all with the same bits.
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
