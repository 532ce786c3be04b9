#ifndef mesoslip_dynamics_grid_temporal_blocking_h
#define mesoslip_dynamics_grid_temporal_blocking_h

#include "dynamics/grid/step_masses.h"
#include "dynamics/grid/swept_state.h"
#include "dynamics/supports/platen_column.h"
#include "dynamics/supports/side_column.h"
#include "dynamics/surface_condition.h"
#include "elasticity/row_sweep.h"
#include "grid/halo.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesoslip
{
/** Inputs of the time integration on one rank; the caller owns all of them. */
struct SteppedBody
{
  const UniformMaterial &material; ///< stiffness and density of all cells of the grid
  const StepParameters parameters; ///< time step, beta2, damping and weight
  NodalField<double> &u;           ///< displacement (m)
  NodalField<double> &w;           ///< velocity of the scheme (m/s)

  /** Condition of the bottom row; null: FreeSurface. */
  SurfaceCondition<2> *bottom = nullptr;
  SurfaceCondition<2> *top    = nullptr; ///< condition of the top row; null: FreeSurface

  /** Locally owned node rows and ghost rows. */
  NodeRows rows = NodeRows::all(material.n_rows());

  Halo *halo            = nullptr;       ///< required if a rank has neighbours
  MPI_Comm communicator = MPI_COMM_SELF; ///< ranks that share the grid

  std::vector<SideColumn *> columns = {}; ///< left or right column, if loaded

  std::vector<PlatenColumn *> platens = {}; ///< left or right, moved by a platen

  const UniformMaterial *damping = nullptr; ///< material of phases_of_damping(), or null
};

/** Time steps of the rows of one rank, several in a sweep. Internal to the stepper. */
class Sweeps
{
public:
  virtual ~Sweeps() = default;

  /** Largest number of steps in a sweep. */
  virtual unsigned int max_steps() const = 0;

  /** Reads the state from the fields of the body. Required before the first sweep and
   * after something else moved rows. */
  virtual void load() = 0;

  /** Writes the state to the fields of the body. */
  virtual void save() = 0;

  /** Whether load() would change nothing. */
  virtual bool is_current() const = 0;

  /** Sends the neighbours the rows for the next @p n_steps steps. */
  virtual void send(const unsigned int n_steps) = 0;

  /** Runs @p n_steps steps from step @p first on, whose ghost rows have been sent; sends
   * the rows for the @p n_next steps after them. */
  virtual void run(const std::uint64_t first,
                   const unsigned int n_steps,
                   const unsigned int n_next) = 0;

  /** Kernel variant and precision, as text. */
  virtual std::string kernel_name() const = 0;
};

/**
 * Temporal blocking (time skewing): several time steps in one sweep over the rows. Each
 * step is a stage that moves from the bottom to the top. It follows the previous stage as
 * closely as possible: a row needs the row above it to have finished the previous step.
 * One stage is the plain sweep.
 *
 * On a slab, n steps start with n ghost rows from each neighbour. Stage s also advances
 * the n - 1 - s nearest ghost rows, so that the last stage has all its input, and ranks
 * communicate once in n steps.
 *
 * In single precision (@p Number is float) the bottom and the top row keep their state in
 * the fields of the body, in double precision, and kernels read a rounded copy. save()
 * writes the other rows as the kernels have them, so that load() restores the same bits.
 * Internal to the stepper.
 */
template <typename Number>
class TemporalBlocking : public Sweeps
{
public:
  /** At most @p max_steps steps in a sweep, with the kernels of @p isa. */
  TemporalBlocking(const SteppedBody &body,
                   const SideConstraints &sides,
                   const InstructionSet isa,
                   const unsigned int max_steps,
                   const PhaseDamping *damping = nullptr);

  unsigned int max_steps() const override
  {
    return stages.size();
  }

  void load() override;
  void save() override;
  bool is_current() const override;
  void send(const unsigned int n_steps) override;
  void run(const std::uint64_t first,
           const unsigned int n_steps,
           const unsigned int n_next) override;
  std::string kernel_name() const override;

private:
  struct Stage
  {
    Stage(const UniformMaterial &material, const RowKernels<Number> &kernels);

    RowSweep<Number> sweep;
    NodalField<Number> forces;
    std::uint64_t step = 0;
    /** Advances the rows begin to end (global indices); rows below next are done. */
    unsigned int begin = 0, end = 0, next = 0;
  };

  void start(Stage &stage, const std::uint64_t step, const unsigned int n_more);
  unsigned int first_limit(const unsigned int stride) const;
  unsigned int limit_behind(const Stage &before) const;
  void advance(Stage &stage, const unsigned int limit);
  void advance_rows(Stage &stage, const unsigned int n);
  void advance_boundary(Stage &stage);
  void damp_rows(Stage &stage, const unsigned int n);

  void save(const unsigned int begin, const unsigned int end);
  void send(const Halo::Side side, const unsigned int j, const unsigned int n);
  void receive(const Halo::Side side, const unsigned int j, const unsigned int n);
  kernels::Rows<Number> kernel_rows(Stage &stage, const unsigned int j);
  std::array<double *, 2> boundary_forces(Stage &stage);
  RowBlock block(const unsigned int j, const unsigned int n) const;

  const SteppedBody body;
  const RowKernels<Number> kernels;
  StepMasses<Number> masses;
  const PhaseDamping *const damping;
  const unsigned int at_once;
  SweptState<Number> state;
  std::vector<Stage> stages;
  NodalField<double> boundary_force; ///< forces (N/m) on the bottom or top row

  /** Ghost rows above that have not been received yet. */
  unsigned int missing_above = 0;
};

extern template class TemporalBlocking<double>;
extern template class TemporalBlocking<float>;
} // namespace mesoslip

#endif
