#ifndef mesoslip_dynamics_temporal_blocking_h
#define mesoslip_dynamics_temporal_blocking_h

#include "dynamics/step_masses.h"
#include "dynamics/surface_condition.h"
#include "elasticity/row_sweep.h"
#include "grid/halo.h"
#include "grid/nodal_field.h"
#include "grid/node_rows.h"

#include <cstdint>
#include <vector>

namespace mesoslip
{
/** What the time steps of one rank work on, all of it owned elsewhere. */
struct SteppedBody
{
  const UniformMaterial &material; ///< of the whole grid
  const StepParameters parameters; ///< of the scheme
  NodalField<double> &u;           ///< displacement (m)
  NodalField<double> &w;           ///< velocity of the scheme (m/s)

  /** What moves the bottom and the top row of the grid; null: FreeSurface. */
  SurfaceCondition<2> *bottom = nullptr;
  SurfaceCondition<2> *top    = nullptr; ///< see bottom

  /** Node rows that this rank owns, and its ghost rows. */
  NodeRows rows = NodeRows::all(material.n_rows());

  Halo *halo            = nullptr;       ///< needed where a rank has neighbours
  MPI_Comm communicator = MPI_COMM_SELF; ///< of the ranks that share the grid
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
                   const unsigned int max_steps);

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

  kernels::Rows<double> kernel_rows(Stage &stage, const unsigned int j) const;
  RowBlock block(const unsigned int j, const unsigned int n) const;

  const SteppedBody body;
  const RowKernels<double> &kernels;
  const StepMasses &masses;
  const unsigned int at_once;
  std::vector<Stage> stages;

  /** Ghost rows above that are still to be received. */
  unsigned int missing_above = 0;
};
} // namespace mesoslip

#endif
