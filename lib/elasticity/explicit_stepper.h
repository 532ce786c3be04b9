#ifndef mesoslip_elasticity_explicit_stepper_h
#define mesoslip_elasticity_explicit_stepper_h

#include "elasticity/instruction_set.h"
#include "elasticity/node_rows.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"

#include <array>
#include <cstdint>
#include <memory>

namespace mesoslip
{
/** Constants of the beta2 scheme and of the bulk. */
struct StepParameters
{
  /** Time step (s). */
  double dt = 0.;

  /** 1/2: leapfrog, order two; up to 1: numerically damped. */
  double beta2 = 0.5;

  /** Stiffness-proportional damping C = beta K (s); zero costs nothing. */
  double beta = 0.;

  /** Body acceleration (m/s^2); zero costs nothing. */
  std::array<double, 2> acceleration = {};
};

/** Components of the leftmost and rightmost column whose acceleration is kept at zero. */
struct SideConstraints
{
  std::array<bool, 2> left_held  = {};
  std::array<bool, 2> right_held = {};
};

/**
 * One boundary row of nodes, at the moment when its forces of step n are complete. All
 * arrays have n_columns entries; with a periodic grid the last one duplicates the first
 * and has to be given the same values.
 */
struct RowView
{
  /** State before the step, to be advanced in place: u_n and w_n. */
  double *ux = nullptr;
  double *uy = nullptr;
  double *wx = nullptr;
  double *wy = nullptr;

  /** K (u_n + beta w_n) minus body forces (N/m): the acceleration is
   *  inverse_mass * (boundary force - f). */
  const double *fx = nullptr;
  const double *fy = nullptr;

  /** One over the lumped mass (m/kg), zero where a side holds the component: such a
   *  component keeps its w. */
  const double *inverse_mass_x = nullptr;
  const double *inverse_mass_y = nullptr;

  unsigned int n_columns = 0;

  /** n, counted from the first step of the stepper (or from set_step_number()). */
  std::uint64_t step = 0;

  /** n dt (s), the time of u_n. */
  double time = 0.;
};

/**
 * What happens on the bottom or top row: turns forces into motion,
 *
 *     a = inverse_mass (boundary force - f)
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a      (w: the new one)
 *
 * Called once each step, in order of time. Within advance() the bottom row may be several
 * steps ahead of the top row, so the two must not talk to each other during advance(),
 * and neither may look at other rows of the field.
 */
struct BoundaryRow
{
  virtual ~BoundaryRow() = default;

  virtual void advance(const RowView &row) = 0;
};

/** No boundary force: the row moves freely (sides held as inverse_mass says). */
class FreeRow : public BoundaryRow
{
public:
  explicit FreeRow(const StepParameters &parameters);

  void advance(const RowView &row) override;

private:
  double dt;
  double c_new;
  double c_old;
};

/** Four rows of n numbers: x and y components of u and of w. */
struct RowState
{
  double *ux = nullptr;
  double *uy = nullptr;
  double *wx = nullptr;
  double *wy = nullptr;
};

/**
 * Exchange with the ranks below and above, called by the stepper on a slab. Each sweep
 * goes from the lowest to the highest row, so the lowest own row can be sent early and
 * the upper ghost row is needed late; a rank that lags its lower neighbour by the latency
 * of a message never waits. Only sides that have a neighbour are called.
 */
struct Halo
{
  virtual ~Halo() = default;

  /** The own lowest row is final for this time: start sending it. */
  virtual void send_lower(const RowState &own_lowest) = 0;

  /** The own highest row is final for this time: start sending it. */
  virtual void send_upper(const RowState &own_highest) = 0;

  /** Wait for the lower neighbour's highest row and store it in the ghost row. */
  virtual void receive_lower(const RowState &ghost) = 0;

  /** Wait for the upper neighbour's lowest row and store it in the ghost row. */
  virtual void receive_upper(const RowState &ghost) = 0;

  /** Called now and then between rows: lets messages move. */
  virtual void progress()
  {
  }
};

/** How a sweep is run; never changes a bit of the result. */
struct SweepOptions
{
  InstructionSet isa = InstructionSet::automatic;

  /** Time steps in flight in advance(): 0 chooses by cache size, 1 is the plain sweep. A
   *  stepper with a halo always runs the plain sweep. */
  unsigned int wavefront = 0;
};

/**
 * Explicit time integration of the bulk on a uniform grid, force and update fused in one
 * pass over the rows, in place:
 *
 *     a = M^-1 (boundary forces + M g - K (u + beta w))
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a
 *
 * which is the beta2 scheme with v = w + beta2 dt a where a velocity is reported (w alone
 * is v_n - beta2 dt a_n, see doc/). Inner rows are advanced by the kernel, the bottom and
 * the top row by the given BoundaryRow objects.
 *
 * @p u and @p w, the material and the boundary rows are referenced and must outlive the
 * stepper; the fields have material.n_columns() columns and rows.n_local() rows. On a
 * slab every rank needs at least two own rows, and ghost rows are stale after advance().
 */
class ExplicitStepper
{
public:
  /** All rows on one rank. Null boundary rows mean FreeRow. */
  ExplicitStepper(const UniformMaterial &material,
                  const StepParameters &parameters,
                  const SideConstraints &sides,
                  NodalField<double> &u,
                  NodalField<double> &w,
                  BoundaryRow *bottom         = nullptr,
                  BoundaryRow *top            = nullptr,
                  const SweepOptions &options = SweepOptions());

  /** On a slab; @p halo is used on the sides that have a neighbour. */
  ExplicitStepper(const UniformMaterial &material,
                  const NodeRows &rows,
                  const StepParameters &parameters,
                  const SideConstraints &sides,
                  NodalField<double> &u,
                  NodalField<double> &w,
                  BoundaryRow *bottom,
                  BoundaryRow *top,
                  Halo *halo,
                  const SweepOptions &options = SweepOptions());

  ~ExplicitStepper();

  /** One time step. */
  void step();

  /** @p n_steps time steps, several at a time where the grid exceeds the cache. */
  void advance(const std::uint64_t n_steps);

  /** Steps done so far. */
  std::uint64_t step_number() const;

  /** For a resumed run: the next step is step @p n. */
  void set_step_number(const std::uint64_t n);

  /** Steps in flight that advance() uses. */
  unsigned int wavefront_depth() const;

  /** For the log: kernel variant and instruction set. */
  const char *kernel_name() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};
} // namespace mesoslip

#endif
