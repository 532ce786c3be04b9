#ifndef mesoslip_dynamics_stepper_h
#define mesoslip_dynamics_stepper_h

#include "dynamics/deformation.h"
#include "dynamics/phase_damping.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <mpi.h>
#include <string>
#include <vector>

namespace mesoslip
{
class Timer;

/** Constants of the beta2 scheme and of the bulk. */
struct StepParameters
{
  /** Time step (s). */
  double dt = 0.;

  /** 1/2: leapfrog, order two; up to 1: numerically damped. */
  double beta2 = 0.5;

  /** Stiffness-proportional damping C = beta K (s), the largest of the phases; zero costs nothing. */
  double beta = 0.;

  /** Mass-proportional damping alpha M (1/s), the largest of the phases; zero costs nothing. */
  double alpha = 0.;

  /** beta of each phase p, C = alpha M + sum of beta_p K_p, see PhaseDamping; empty: beta everywhere. */
  std::vector<double> beta_of_phases;

  /** alpha likewise, which then does not act on masses without a phase, those of supports. */
  std::vector<double> alpha_of_phases;

  /** Whether beta or alpha differ by phase. */
  bool damps_by_phase() const
  {
    return !beta_of_phases.empty() || !alpha_of_phases.empty();
  }

  /** beta where there is one for all phases; else PhaseDamping has it, and this is 0. */
  double common_beta() const
  {
    return beta_of_phases.empty() ? beta : 0.;
  }

  /** The same of alpha; it acts on masses without a phase, those of supports, as well. */
  double common_alpha() const
  {
    return alpha_of_phases.empty() ? alpha : 0.;
  }

  /** The smallest beta of a phase. */
  double least_beta() const
  {
    return beta_of_phases.empty()
             ? beta
             : *std::min_element(beta_of_phases.begin(), beta_of_phases.end());
  }

  /** Body acceleration (m/s^2), the last one unused in 2D; zero costs nothing. */
  std::array<double, 3> acceleration = {};

  /** Whether there is a body acceleration. */
  bool is_heavy() const
  {
    return acceleration != std::array<double, 3>{};
  }

  /**
   * What the damping alpha M makes of the mass in a step. It acts on the mean of w_n and w_(n+1), that
   * is, on w_n + dt a_n / 2: M (1 + alpha dt / 2) a_n = f - alpha M w_n, f being all other forces.
   */
  double inertia() const
  {
    return 1. + 0.5 * common_alpha() * dt;
  }

  /** Whether there are forces in proportion to the mass. */
  bool acts_on_mass() const
  {
    return is_heavy() || common_alpha() > 0.;
  }
};

/** Components of the leftmost and rightmost column whose acceleration is kept at zero. */
struct SideConstraints
{
  std::array<bool, 2> left_held  = {}; ///< x and y of the leftmost column
  std::array<bool, 2> right_held = {}; ///< x and y of the rightmost column
};

/**
 * Explicit time integration of a body, as the time loop and its observers see it:
 * whatever the nodes lie on, in two dimensions or three, u and w of this rank's nodes are
 * the rows of a field with as many components, the last one along the normal of the
 * contact, and between two calls they are, with the surfaces, all the state there is.
 */
class Stepper
{
public:
  virtual ~Stepper() = default;

  /** @p n_steps time steps, several at a time where that is faster. Collective. */
  virtual void advance(const std::uint64_t n_steps) = 0;

  /** One time step; then the nearest ghost rows hold the state before it. */
  void step()
  {
    advance(1);
  }

  /** Kc = K x with forces (N, in 2D N/m) on owned rows; the ghost rows of @p x are updated first.
   *  Collective. */
  virtual void multiply(NodalField<double> &Kx, NodalField<double> &x) const = 0;

  /** Damping that differs by phase; null: it does not. */
  const PhaseDamping *phase_damping() const
  {
    return by_phase.get();
  }

  /** alpha of a node of this mass (kg, in 2D kg/m), the mean of its phases by mass (1/s). */
  double alpha_of(const NodeIndex &node, const double mass) const
  {
    return parameters.alpha_of_phases.empty() ? parameters.alpha
                                              : by_phase->drag(node) / mass;
  }

  /** What the node resists its acceleration with, see StepParameters::inertia() (kg, in 2D kg/m). */
  double inertia_of(const NodeIndex &node, const double mass) const
  {
    return mass * (1. + 0.5 * alpha_of(node, mass) * parameters.dt);
  }

  /** 1/2 u.K u of the owned nodes (J, in 2D J/m). Collective. */
  virtual double elastic_energy() const = 0;

  /** Lumped masses (kg, in 2D kg/m) of the nodes of owned row @p j (global number). */
  virtual void mass_row(const unsigned int j, double *mass) const = 0;

  /** Extremes of strain, rotation and Jacobian over all cells. Collective. */
  virtual Deformation deformation() const = 0;

  /** For the log: what advances the nodes. */
  virtual std::string kernel_name() const = 0;

  /** Steps done so far. */
  std::uint64_t step_number() const
  {
    return n_done;
  }

  /** For a resumed run: the next step is step @p n. */
  void set_step_number(const std::uint64_t n)
  {
    n_done = n;
  }

  /** Time step, scheme, damping and body acceleration. */
  const StepParameters parameters;

  NodalField<double> &u; ///< displacement (m), own and ghost rows
  NodalField<double> &w; ///< velocity of the scheme (m/s)
  const NodeRows rows;   ///< node rows that this rank owns, and its ghost rows

  /** In each row the first nodes that are no duplicates of others. */
  const unsigned int n_distinct;

  const MPI_Comm communicator; ///< of the ranks that share the body

protected:
  /** All but the step number, which is 0. */
  Stepper(const StepParameters &parameters,
          NodalField<double> &u,
          NodalField<double> &w,
          const NodeRows &rows,
          const unsigned int n_distinct,
          const MPI_Comm communicator,
          std::unique_ptr<PhaseDamping> by_phase = nullptr)
    : parameters(parameters)
    , u(u)
    , w(w)
    , rows(rows)
    , n_distinct(n_distinct)
    , communicator(communicator)
    , by_phase(std::move(by_phase))
  {
  }

  std::uint64_t n_done = 0;                     ///< see step_number()
  const std::unique_ptr<PhaseDamping> by_phase; ///< see phase_damping()
};

/**
 * Something that looks at the whole body now and then. Between two steps that somebody
 * wants to see, the stepper is free to advance many steps at a time.
 */
class StepObserver
{
public:
  virtual ~StepObserver() = default;

  /** The first step >= @p n around which this observer wants to be called. */
  virtual std::uint64_t next_step(const std::uint64_t n) const = 0;

  /** The fields hold u_n and w_n. */
  virtual void before_step(const std::uint64_t n) = 0;

  /** The fields hold u_(n+1) and w_(n+1). */
  virtual void after_step(const std::uint64_t)
  {
  }
};

/** The first multiple of @p interval that is >= @p n. */
inline std::uint64_t next_multiple(const std::uint64_t n, const std::uint64_t interval)
{
  return (n + interval - 1) / interval * interval;
}

/**
 * Advances @p stepper until step @p n_end, calling the observers around the steps that
 * they ask for and @p keep_going every @p control_interval steps (and at the end).
 * With a @p timer the steps are timed. Returns the number of the next step: less than @p
 * n_end when @p keep_going said false.
 */
std::uint64_t run_time_loop(Stepper &stepper,
                            const std::vector<StepObserver *> &observers,
                            const std::uint64_t n_end,
                            const std::uint64_t control_interval,
                            const std::function<bool(const std::uint64_t)> &keep_going,
                            Timer *timer = nullptr);
} // namespace mesoslip

#endif
