#ifndef mesoslip_dynamics_step_masses_h
#define mesoslip_dynamics_step_masses_h

#include "dynamics/surface_condition.h"
#include "elasticity/row_kernel.h"
#include "elasticity/uniform_material.h"
#include "grid/nodal_field.h"
#include "grid/node_rows.h"

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
             const SideConstraints &sides);

  /** Factors (and masses) of the stepping kernel for local node row @p l and above. */
  void set_inner(kernels::Rows<double> &r, const unsigned int l) const;

  /** Masses and inverse masses of the bottom or top row. */
  void set_boundary(kernels::Rows<double> &r, SurfaceView<2> &view, const bool top) const;

private:
  /** Inverse masses, zero where held, and masses of global node row @p j. */
  void inverse_mass_row(const UniformMaterial &material,
                        const SideConstraints &sides,
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
} // namespace mesoslip

#endif
