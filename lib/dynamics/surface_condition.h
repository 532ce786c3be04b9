#ifndef mesoslip_dynamics_surface_condition_h
#define mesoslip_dynamics_surface_condition_h

#include "dynamics/stepper.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace mesoslip
{
/**
 * The nodes of one boundary surface at the moment when their forces of step n are
 * complete: an array of n values for each component, the last one along the normal. On a
 * grid the arrays are rows of the fields, without a copy; on a periodic one the last node
 * duplicates the first and has to be given the same values.
 */
template <int dim>
struct SurfaceView
{
  std::size_t n = 0; ///< number of nodes, with copies of those of other ranks

  /** u_n (m) and w_n (m/s), to be advanced in place. */
  std::array<double *, dim> u = {};
  std::array<double *, dim> w = {}; ///< velocity of the scheme (m/s)

  /** K (u_n + beta w_n) minus body forces (N/m): the acceleration is
   *  inverse_mass * (boundary force - force). */
  std::array<const double *, dim> force = {};

  /** One over the lumped mass (m/kg), zero where a component is constrained: such a
   *  component keeps its w. */
  std::array<const double *, dim> inverse_mass = {};

  /** n, counted from the first step of the stepper (or from set_step_number()). */
  std::uint64_t step = 0;

  /** n dt (s), the time of u_n. */
  double time = 0.;

  /** Sum of the forces of all ranks (N/m), where the condition wants it and the surface is
   *  shared among ranks; else null. */
  const double *total_force = nullptr;
};

/** The sum of @p n values by eight partial sums: the order is fixed, and the loop does not
 * wait for one addition before it starts the next. */
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
 * What happens on a boundary surface: turns forces into motion,
 *
 *     a = inverse_mass (boundary force - force)
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a      (w: the new one)
 *
 * Called once each step, in order of time. Within advance() the bottom may be several
 * steps ahead of the top, so the two must not talk to each other during advance(), and
 * neither may look at other nodes of the body.
 */
template <int dim>
struct SurfaceCondition
{
  virtual ~SurfaceCondition() = default;

  /** Whether the nodes depend on the sum of their forces (SurfaceView::total_force). */
  virtual bool wants_total_force() const
  {
    return false;
  }

  /** One step of the surface: on a grid on the rank that has it, on a mesh on all ranks,
   * each with the nodes that it has. */
  virtual void advance(const SurfaceView<dim> &surface) = 0;
};

/** No boundary force: the surface moves freely (constrained as inverse_mass says). */
template <int dim>
class FreeSurface : public SurfaceCondition<dim>
{
public:
  /** Time step and beta2 are taken from @p parameters. */
  explicit FreeSurface(const StepParameters &parameters)
    : dt(parameters.dt)
    , c_new(parameters.dt * (parameters.beta2 + 0.5))
    , c_old(-parameters.dt * (parameters.beta2 - 0.5))
  {
  }

  /** w_(n+1) from the internal forces alone. */
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
