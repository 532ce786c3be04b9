#ifndef mesoslip_dynamics_surface_condition_h
#define mesoslip_dynamics_surface_condition_h

#include "dynamics/stepper.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mesoslip
{
/**
 * Nodes of one boundary surface at the moment when their forces of step n are complete:
 * an array of n values for each component, the last one along the normal. On a grid the
 * arrays are rows of the fields; on a periodic grid the last node is the periodic copy of
 * the first and must be given the same values.
 */
template <int dim>
struct SurfaceView
{
  std::size_t n = 0; ///< number of nodes, ghost nodes included

  /** u_n (m) and w_n (m/s), to be advanced in place. */
  std::array<double *, dim> u = {};
  std::array<double *, dim> w = {}; ///< velocity of the scheme (m/s)

  /** K (u_n + beta w_n) minus body forces (N/m): the acceleration is
   *  inverse_mass * (boundary force - force). */
  std::array<const double *, dim> force = {};

  /** Inverse lumped mass (m/kg); zero for constrained components, which keep their w. */
  std::array<const double *, dim> inverse_mass = {};

  /**
   * Step number n, counted from the first step of the stepper (or from
   * set_step_number()).
   */
  std::uint64_t step = 0;

  /** n dt (s), the time of u_n. */
  double time = 0.;

  /**
   * Sum of the forces over all ranks (N/m) if the condition needs it and ranks share the
   * surface; else null.
   */
  const double *total_force = nullptr;
};

/**
 * Sum of @p n values by eight partial sums: fixed order, and additions do not wait for
 * one another.
 */
inline double sum_of(const double *values, const std::size_t n)
{
  double lanes[8] = {};
  std::size_t i   = 0;
  for (; i + 8 <= n; i += 8)
    for (unsigned int l = 0; l < 8; ++l)
      lanes[l] += values[i + l];
  double sum = 0.;
  for (; i < n; ++i)
    sum += values[i];
  for (unsigned int l = 0; l < 8; ++l)
    sum += lanes[l];
  return sum;
}

/**
 * Condition on a boundary surface: turns forces into motion,
 *
 *     a = inverse_mass (boundary force - force)
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a      (w: the new one)
 *
 * Called once per step, in order of time. Within advance() of a stepper the bottom may be
 * several steps ahead of the top. The two conditions must therefore not communicate, and
 * must not read other nodes of the body.
 */
template <int dim>
struct SurfaceCondition
{
  virtual ~SurfaceCondition() = default;

  /** Whether the motion depends on the sum of the forces (SurfaceView::total_force). */
  virtual bool wants_total_force() const
  {
    return false;
  }

  /**
   * Advances the surface by one step: on a grid on the rank that has the row, on a mesh
   * on all ranks, each with its own nodes.
   */
  virtual void advance(const SurfaceView<dim> &surface) = 0;
};

/** Surface without boundary forces (constraints by inverse_mass). */
template <int dim>
class FreeSurface : public SurfaceCondition<dim>
{
public:
  /** Uses time step and beta2 of @p parameters. */
  explicit FreeSurface(const StepParameters &parameters)
    : dt(parameters.dt)
    , c_new(parameters.dt * (parameters.beta2 + 0.5))
    , c_old(-parameters.dt * (parameters.beta2 - 0.5))
  {
  }

  /** Computes w_(n+1) from the internal forces alone. */
  void advance(const SurfaceView<dim> &surface) override
  {
    for (unsigned int c = 0; c < dim; ++c)
      for (std::size_t i = 0; i < surface.n; ++i)
        {
          double &w          = surface.w[c][i];
          const double w_old = w;
          w -= dt * surface.inverse_mass[c][i] * surface.force[c][i];
          surface.u[c][i] += c_new * w + c_old * w_old;
        }
  }

private:
  const double dt, c_new, c_old;
};
} // namespace mesoslip

#endif
