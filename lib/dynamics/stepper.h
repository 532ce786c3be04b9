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

  /** Stiffness-proportional damping C = beta K (s), largest value of the phases. */
  double beta = 0.;

  /** Mass-proportional damping alpha M (1/s), largest value of the phases. */
  double alpha = 0.;

  /**
   * beta of each phase p (s), C = alpha M + sum of beta_p K_p, see PhaseDamping; empty:
   * common beta.
   */
  std::vector<double> beta_of_phases;

  /**
   * alpha of each phase (1/s), which does not act on masses of supports; empty: common
   * alpha.
   */
  std::vector<double> alpha_of_phases;

  /** Whether beta or alpha differ by phase. */
  bool damps_by_phase() const
  {
    return !beta_of_phases.empty() || !alpha_of_phases.empty();
  }

  /** The common beta (s); 0 if it differs by phase, see PhaseDamping. */
  double common_beta() const
  {
    return beta_of_phases.empty() ? beta : 0.;
  }

  /**
   * The common alpha (1/s); 0 if it differs by phase. It also acts on masses of supports.
   */
  double common_alpha() const
  {
    return alpha_of_phases.empty() ? alpha : 0.;
  }

  /** Smallest beta of a phase (s). */
  double least_beta() const
  {
    return beta_of_phases.empty()
             ? beta
             : *std::min_element(beta_of_phases.begin(), beta_of_phases.end());
  }

  /** Body acceleration (m/s^2); the last component is not used in 2D. */
  std::array<double, 3> acceleration = {};

  /** Whether there is a body acceleration. */
  bool is_heavy() const
  {
    return acceleration != std::array<double, 3>{};
  }

  /**
   * Factor of the mass by damping alpha M in a step. The damping acts on the mean of w_n
   * and w_(n+1), i.e. on w_n + dt a_n / 2: M (1 + alpha dt / 2) a_n = f - alpha M w_n
   * with all other forces f.
   */
  double inertia() const
  {
    return 1. + 0.5 * common_alpha() * dt;
  }

  /** Whether there are mass-proportional forces. */
  bool acts_on_mass() const
  {
    return is_heavy() || common_alpha() > 0.;
  }
};

/**
 * Constrained components of the leftmost and rightmost column; their acceleration is
 * zero.
 */
struct SideConstraints
{
  std::array<bool, 2> left_held  = {}; ///< x and y of the leftmost column
  std::array<bool, 2> right_held = {}; ///< x and y of the rightmost column
};

/**
 * Interface of explicit time integration of a body for the time loop and its observers.
 * For any layout of nodes, in 2D or 3D, u and w of the nodes of this rank are the rows of
 * a field with dim components, the last one along the normal of the contact. Between two
 * calls, u, w and the surfaces are the complete state.
 */
class Stepper
{
public:
  virtual ~Stepper() = default;

  /**
   * Advances by @p n_steps time steps, several at a time if that is faster. Collective.
   */
  virtual void advance(const std::uint64_t n_steps) = 0;

  /**
   * Advances by one time step; afterwards the nearest ghost rows hold the previous state.
   */
  void step()
  {
    advance(1);
  }

  /**
   * Kx = K x, forces on owned rows (N, in 2D N/m); updates the ghost rows of @p x first.
   * Collective.
   */
  virtual void multiply(NodalField<double> &Kx, NodalField<double> &x) const = 0;

  /** Damping that differs by phase; null if it does not. */
  const PhaseDamping *phase_damping() const
  {
    return by_phase.get();
  }

  /**
   * alpha of a node with this mass (kg, in 2D kg/m), the mass-weighted mean of its phases
   * (1/s).
   */
  double alpha_of(const NodeIndex &node, const double mass) const
  {
    return parameters.alpha_of_phases.empty() ? parameters.alpha
                                              : by_phase->drag(node) / mass;
  }

  /** Inertia of a node, see StepParameters::inertia() (kg, in 2D kg/m). */
  double inertia_of(const NodeIndex &node, const double mass) const
  {
    return mass * (1. + 0.5 * alpha_of(node, mass) * parameters.dt);
  }

  /** 1/2 u.K u of the locally owned nodes (J, in 2D J/m). Collective. */
  virtual double elastic_energy() const = 0;

  /** Lumped masses (kg, in 2D kg/m) of the nodes of owned row @p j (global index). */
  virtual void mass_row(const unsigned int j, double *mass) const = 0;

  /** Extremes of strain, rotation and Jacobian over all cells. Collective. */
  virtual Deformation deformation() const = 0;

  /** Description of the kernel for the log. */
  virtual std::string kernel_name() const = 0;

  /** Number of steps done. */
  std::uint64_t step_number() const
  {
    return n_done;
  }

  /** Sets the number of the next step of a resumed run. */
  void set_step_number(const std::uint64_t n)
  {
    n_done = n;
  }

  /** Time step, scheme, damping and body acceleration. */
  const StepParameters parameters;

  NodalField<double> &u; ///< displacement (m), owned and ghost rows
  NodalField<double> &w; ///< velocity of the scheme (m/s)
  const NodeRows rows;   ///< owned node rows and ghost rows of this rank

  /** Number of nodes in each row without periodic copies. */
  const unsigned int n_distinct;

  const MPI_Comm communicator; ///< ranks that share the body

protected:
  /** Sets all members; the step number is 0. */
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
 * Observer of the whole body in selected steps. Between these steps the stepper may
 * advance many steps at a time.
 */
class StepObserver
{
public:
  virtual ~StepObserver() = default;

  /** First step >= @p n around which the observer is called. */
  virtual std::uint64_t next_step(const std::uint64_t n) const = 0;

  /** Called before the step, with fields u_n and w_n. */
  virtual void before_step(const std::uint64_t n) = 0;

  /** Called after the step, with fields u_(n+1) and w_(n+1). */
  virtual void after_step(const std::uint64_t)
  {
  }
};

/** First multiple of @p interval that is >= @p n. */
inline std::uint64_t next_multiple(const std::uint64_t n, const std::uint64_t interval)
{
  return (n + interval - 1) / interval * interval;
}

/**
 * Advances @p stepper until step @p n_end. Calls the observers around the steps they
 * request, and @p keep_going every @p control_interval steps and at the end. With a
 * @p timer the steps are timed. Returns the number of the next step, which is less than
 * @p n_end if @p keep_going returned false.
 */
std::uint64_t run_time_loop(Stepper &stepper,
                            const std::vector<StepObserver *> &observers,
                            const std::uint64_t n_end,
                            const std::uint64_t control_interval,
                            const std::function<bool(const std::uint64_t)> &keep_going,
                            Timer *timer = nullptr);
} // namespace mesoslip

#endif
