#ifndef mesoslip_dynamics_temporal_blocking_h
#define mesoslip_dynamics_temporal_blocking_h

#include "dynamics/stepper.h"
#include "dynamics/supports/platen_column.h"
#include "dynamics/supports/side_column.h"
#include "dynamics/surface_condition.h"
#include "elasticity/row_sweep.h"
#include "grid/halo.h"
#include "grid/nodal_field.h"
#include "grid/row_partition.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace mesoslip
{
/**
 * Masses in the formats of a time step. Inner rows have the factor -dt / mass of the
 * kernel, times h/2, which is missing in the forces of the kernel. With uniform density
 * it is one row, which stays in the first-level cache; otherwise one row per node row.
 * Internal to the stepper.
 */
class StepMasses
{
public:
  /**
   * Lumped masses of the rows of one rank, combined with constants of the time scheme.
   */
  StepMasses(const UniformMaterial &material,
             const NodeRows &rows,
             const StepParameters &parameters,
             const SideConstraints &sides,
             const UniformMaterial *damping = nullptr);

  /**
   * Sets the factors (and masses) of the stepping kernel for local node row @p l and
   * above.
   */
  void set_inner(kernels::Rows<double> &r, const unsigned int l) const;

  /** Adds the guest masses of columns to the end nodes of the bottom or @p top row. */
  void add_guests(const bool top, const std::vector<SideColumn *> &columns);

  /** Sets masses and inverse masses of the bottom or top row. */
  void set_boundary(kernels::Rows<double> &r, SurfaceView<2> &view, const bool top) const;

private:
  /** Inverse inertias (zero where constrained) and masses of global node row @p j. */
  void inverse_mass_row(const UniformMaterial &material,
                        const SideConstraints &sides,
                        const std::vector<double> &inertia,
                        const unsigned int j,
                        double *x,
                        double *y,
                        double *mass) const;

  /** Bottom and top row. */
  NodalField<double> inverse_boundary[2], mass_boundary[2];

  /** Inner rows. */
  NodalField<double> factor, mass;
  bool one_row;
  bool has_mass;
  /** Whether the factors of x and y are equal. */
  bool equal_components;
};

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

/**
 * Temporal blocking (time skewing): several time steps in one sweep over the rows. Each
 * step is a stage that moves from the bottom to the top. It follows the previous stage as
 * closely as possible: a row needs the row above it to have finished the previous step.
 * One stage is the plain sweep.
 *
 * On a slab, n steps start with n ghost rows from each neighbour. Stage s also advances
 * the n - 1 - s nearest ghost rows, so that the last stage has all its input, and ranks
 * communicate once in n steps. Internal to the stepper.
 */
class TemporalBlocking
{
public:
  /** Stages for at most @p max_steps steps per sweep. */
  TemporalBlocking(const SteppedBody &body,
                   const RowKernels<double> &kernels,
                   const StepMasses &masses,
                   const unsigned int max_steps,
                   const PhaseDamping *damping = nullptr);

  /** Number of stages. */
  unsigned int max_steps() const
  {
    return stages.size();
  }

  /** Sends the neighbours the rows for the next @p n_steps steps. */
  void send(const unsigned int n_steps);

  /**
   * Runs @p n_steps steps from step @p first on, whose ghost rows have been sent; sends
   * the rows for the @p n_next steps after them.
   */
  void
  run(const std::uint64_t first, const unsigned int n_steps, const unsigned int n_next);

private:
  struct Stage
  {
    Stage(const UniformMaterial &material, const RowKernels<double> &kernels);

    RowSweep<double> sweep;
    NodalField<double> forces;
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

  kernels::Rows<double> kernel_rows(Stage &stage, const unsigned int j) const;
  RowBlock block(const unsigned int j, const unsigned int n) const;

  const SteppedBody body;
  const RowKernels<double> &kernels;
  const StepMasses &masses;
  const PhaseDamping *const damping;
  const unsigned int at_once;
  std::vector<Stage> stages;

  /** Ghost rows above that have not been received yet. */
  unsigned int missing_above = 0;
};

} // namespace mesoslip

#endif
