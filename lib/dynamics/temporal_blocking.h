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
 * Masses in the forms a time step wants them. Inner rows get the kernel's factor
 * -dt / mass (times h/2, in which the kernel's forces lack): one row that stays in the
 * first cache when the density is uniform, else one for each node row. Internal to the
 * stepper.
 */
class StepMasses
{
public:
  /** Lumped masses of the rows of one rank, with what the time scheme makes of them. */
  StepMasses(const UniformMaterial &material,
             const NodeRows &rows,
             const StepParameters &parameters,
             const SideConstraints &sides,
             const UniformMaterial *damping = nullptr);

  /** Factors (and masses) of the stepping kernel for local node row @p l and above. */
  void set_inner(kernels::Rows<double> &r, const unsigned int l) const;

  /** Adds the inertia of nodes at the ends of the bottom or @p top row. */
  void add_guests(const bool top, const std::vector<SideColumn *> &columns);

  /** Masses and inverse masses of the bottom or top row. */
  void set_boundary(kernels::Rows<double> &r, SurfaceView<2> &view, const bool top) const;

private:
  /** Inverses of inertias, zero where held, and masses of global node row @p j. */
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
  /** The factors of x and y are the same numbers. */
  bool equal_components;
};

/** What the time steps of one rank work on, all of it owned elsewhere. */
struct SteppedBody
{
  const UniformMaterial &material; ///< stiffness and density of all cells of the grid
  const StepParameters parameters; ///< time step, beta2, damping and weight
  NodalField<double> &u;           ///< displacement (m)
  NodalField<double> &w;           ///< velocity of the scheme (m/s)

  /** What moves the bottom and the top row of the grid; null: FreeSurface. */
  SurfaceCondition<2> *bottom = nullptr;
  SurfaceCondition<2> *top    = nullptr; ///< see bottom

  /** Node rows that this rank owns, and its ghost rows. */
  NodeRows rows = NodeRows::all(material.n_rows());

  Halo *halo            = nullptr;       ///< needed where a rank has neighbours
  MPI_Comm communicator = MPI_COMM_SELF; ///< of the ranks that share the grid

  std::vector<SideColumn *> columns = {}; ///< left or right, where these are loaded

  std::vector<PlatenColumn *> platens = {}; ///< left or right, where platens move these

  const UniformMaterial *damping = nullptr; ///< of phases_of_damping(), where there are
};

/**
 * Temporal blocking (time skewing): several time steps in one sweep over the rows. Each
 * is a stage that goes from the bottom to the top and follows the one before it as
 * closely as it may, a row needing the row above it to have finished the step before. One
 * stage is the plain sweep.
 *
 * On a slab, n steps start with n ghost rows of each neighbour. Stage s also advances the
 * n - 1 - s nearest ones, so the last stage finds all it needs, and the ranks talk once
 * in n steps. Internal to the stepper.
 */
class TemporalBlocking
{
public:
  /** Stages for at most @p max_steps steps in a sweep. */
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

  /** Tell the neighbours what they need for the next @p n_steps steps. */
  void send(const unsigned int n_steps);

  /** @p n_steps steps from step @p first on, whose ghost rows have been sent; sends what
   *  the @p n_next steps after them need. */
  void
  run(const std::uint64_t first, const unsigned int n_steps, const unsigned int n_next);

private:
  struct Stage
  {
    Stage(const UniformMaterial &material, const RowKernels<double> &kernels);

    RowSweep<double> sweep;
    NodalField<double> forces;
    std::uint64_t step = 0;
    /** It advances the rows begin to end (global numbers); those below next are done. */
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

  /** Ghost rows above that are still to be received. */
  unsigned int missing_above = 0;
};

} // namespace mesoslip

#endif
