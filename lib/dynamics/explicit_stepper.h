#ifndef mesoslip_dynamics_explicit_stepper_h
#define mesoslip_dynamics_explicit_stepper_h

#include "dynamics/step_parameters.h"
#include "dynamics/surface_condition.h"
#include "elasticity/uniform_material.h"
#include "grid/halo.h"
#include "grid/nodal_field.h"
#include "grid/node_rows.h"
#include "grid/sweep_options.h"

#include <cstdint>
#include <memory>

namespace mesoslip
{
/**
 * Explicit time integration of the bulk on a uniform grid, force and update fused in one
 * pass over the rows, in place:
 *
 *     a = M^-1 (boundary forces + M g - K (u + beta w))
 *     w += dt a,   u += dt w + (beta2 - 1/2) dt^2 a
 *
 * which is the beta2 scheme with v = w + beta2 dt a where a velocity is reported (w alone
 * is v_n - beta2 dt a_n, see doc/). Inner rows are advanced by the kernel, the bottom and
 * the top row by the given SurfaceCondition<2> objects.
 *
 * @p u and @p w, the material and the boundary rows are referenced and must outlive the
 * stepper; the fields have material.n_columns() columns and rows.n_local() rows. On a
 * slab every rank needs at least two own rows and as many as there are ghost rows.
 *
 * Between calls the own rows of the fields and the boundary rows are all the state there
 * is. The nearest ghost rows hold u_n and w_n after step(), before which they held
 * anything, and anything after advance().
 */
class ExplicitStepper
{
public:
  /** All rows on one rank. Null boundary rows mean FreeSurface<2>. */
  ExplicitStepper(const UniformMaterial &material,
                  const StepParameters &parameters,
                  const SideConstraints &sides,
                  NodalField<double> &u,
                  NodalField<double> &w,
                  SurfaceCondition<2> *bottom = nullptr,
                  SurfaceCondition<2> *top    = nullptr,
                  const SweepOptions &options = SweepOptions());

  /** On a slab; @p halo is used on the sides that have a neighbour. */
  ExplicitStepper(const UniformMaterial &material,
                  const NodeRows &rows,
                  const StepParameters &parameters,
                  const SideConstraints &sides,
                  NodalField<double> &u,
                  NodalField<double> &w,
                  SurfaceCondition<2> *bottom,
                  SurfaceCondition<2> *top,
                  Halo *halo,
                  const SweepOptions &options = SweepOptions());

  ~ExplicitStepper();

  /** One time step, a plain sweep. */
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
