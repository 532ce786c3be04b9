#ifndef mesoslip_dynamics_explicit_stepper_h
#define mesoslip_dynamics_explicit_stepper_h

#include "dynamics/stepper.h"
#include "dynamics/temporal_blocking.h"
#include "elasticity/uniform_grid_operator.h"
#include "grid/row_partition.h"

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
 * What the SteppedBody refers to must outlive the stepper; its fields have
 * material.n_columns() columns and rows.n_local() rows. On a slab every rank needs at
 * least two own rows and as many as there are ghost rows.
 *
 * Between calls the own rows of the fields and the boundary rows are all the state there
 * is. The nearest ghost rows hold u_n and w_n after step(), before which they held
 * anything, and anything after advance().
 */
class ExplicitStepper : public Stepper<2>
{
public:
  /** Throws std::invalid_argument if something does not fit. */
  explicit ExplicitStepper(const SteppedBody &body,
                           const SideConstraints &sides = {},
                           const SweepOptions &options  = {});

  void advance(const std::uint64_t n_steps) override;
  void multiply(NodalField<double> &Kx, NodalField<double> &x) const override;
  double elastic_energy() const override;
  void mass_row(const unsigned int j, double *mass) const override;
  Deformation deformation() const override;

  /** Kernel variant and instruction set. */
  std::string kernel_name() const override;

  /** Steps that advance() does in one sweep. */
  unsigned int steps_at_once() const
  {
    return sweeps.max_steps();
  }

private:
  SteppedBody with_free_surfaces(SteppedBody body);

  const UniformMaterial &material;
  const InstructionSet isa;
  FreeSurface<2> free_surface;
  const RowKernels<double> kernels;
  const StepMasses masses;
  const UniformGridOperator op;
  TemporalBlocking sweeps;
};
} // namespace mesoslip

#endif
